"""Tests of what the sections say, on made-up answers. python3 -m unittest reproduce.test_sections"""

import copy
import unittest
from unittest import mock

from reproduce import chart, formulas
from reproduce.sections import mesh

WITHOUT_BETA = {name: None for name in ("beta", "beta_i_max", "beta_i_mean", "edge_min", "edge_max")}
UNKNOWN = {"beta_upper": None, "r_f_lower": None, "r_c_upper": None}


def spacing_of(beta=0.8, **more):
    low, high = formulas.angle_bounds_deg(beta)
    return {"beta": beta, "r_f": 0.05, "r_c": 0.05 * beta, "beta_i_max": beta, "beta_i_mean": 0.7, "rho": 0.8,
            "coverage": 0.8 * beta, "cell_area_sd": 0.1, "angle_min_deg": low + 1, "angle_max_deg": high - 1,
            "edge_min": 1.0, "edge_max": 1.9 * beta, "valence": {"5": 25, "6": 50, "7": 25}, **more}


def run_of(beta=0.8, converged=True, **more):
    history = [[0, 1.0, 0.05, 0.05], [1, beta, 0.04, 0.05]]
    return {"n": 100, "beta": beta, "rho": 0.8, "sweeps": 1, "converged": converged, "history": history,
            "beta_upper": beta, **more}


def group_of(label, beta=0.8, converged=True, sets=3, rmse=0.1, **spacing):
    one = spacing_of(beta, **spacing)
    return {"label": label, "n": 100, "spacing": {**one, "by_set": [one] * sets},
            "certificate": {"beta_upper": beta, "r_f_lower": 0.05, "r_c_upper": 0.04},
            "bond-order": {"psi6_global": 0.1, "psi6_local": 0.2, "psi6_edges": 0.3},
            "spectrum": {"effective_nyquist": 0.7, "oscillations": 2.0, "anisotropy_mean_db": -4.0,
                         "anisotropy_expected_db": -4.8, "power": [0, 0.5, 2.0]},
            "zone-plate": {"function": "rings", "k": 5.0, "columns": 10, "rows": 10, "sigma": 0.5, "rmse": rmse},
            "distributions": {}, "optimized": [run_of(beta, converged) for _ in range(sets)]}


def without_beta(group):
    """As the service answers for sets of which two points are one: what has no finite value is null."""
    group = copy.deepcopy(group)
    for spacing in (group["spacing"], *group["spacing"]["by_set"]):
        spacing.update(WITHOUT_BETA)
    group["certificate"].update(UNKNOWN)
    group["spectrum"] = {name: [0, None] if name == "power" else None for name in group["spectrum"]}
    group["optimized"] = [run_without_beta() for _ in group["optimized"]]
    return group


def run_without_beta():
    history = [[0, None, 0.05, 0], [1, None, 0.05, 0]]
    return run_of(beta_upper=None, converged=False, history=history) | {"beta": None}


class Charts(unittest.TestCase):
    def curves(self, beta, rho=0.8):
        with mock.patch.object(mesh, "side_by_side", lambda charts, title: charts):
            return mesh.charts([group_of("MPS", 1.0)], [group_of("local", beta, rho=rho)], [group_of("own", 0.75)])

    def test_an_axis_has_its_span_where_all_values_are_within(self):
        axis = chart.axis_over("x", 0.66, 1.02, [0.7, None, 1.0])
        self.assertEqual((axis.low, axis.high), (0.66, 1.02))
        self.assertEqual(chart.axis_over("x", 0, 1, []), chart.Axis("x", 0, 1))

    def test_an_axis_goes_as_far_as_the_values(self):
        axis = chart.axis_over("x", 0.66, 1.02, [0.5, 1.3])
        self.assertTrue(0.4 < axis.low < 0.5 and 1.3 < axis.high < 1.4)

    def test_all_that_the_mesh_charts_show_is_in_their_frames(self):
        for beta, rho in ((0.8, 0.8), (0.6, 0.95), (1.4, 0.3), (3.0, 0.8)):
            for panel in self.curves(beta, rho):
                panel.svg()
                for series in panel.series:
                    for point in series.points:
                        x, y = panel._px(*point)
                        self.assertTrue(chart.LEFT - 0.01 <= x <= panel.width - chart.RIGHT + 0.01, (beta, point))
                        self.assertTrue(panel._top - 0.01 <= y <= panel._bottom + 0.01, (beta, point))

    def test_the_usual_axes_stay_as_they_were(self):
        six, rho = self.curves(0.8)
        self.assertEqual([(axis.low, axis.high) for axis in (six.x, six.y, rho.y)], [(0.66, 1.02), (0.4, 1), (0.55, 1)])

    def test_what_has_no_beta_is_not_drawn(self):
        with mock.patch.object(mesh, "side_by_side", lambda charts, title: charts):
            panel = mesh.charts([], [without_beta(group_of("local"))], [group_of("own", 0.75)])[0]
        self.assertEqual([len(series.points) for series in panel.series], [0, 1])


if __name__ == "__main__":
    unittest.main()
