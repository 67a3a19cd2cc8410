"""Tests of what the sections say, on made-up answers. python3 -m unittest reproduce.test_sections"""

import copy
import re
import types
import unittest
from unittest import mock

from reproduce import chart, formulas, report
from reproduce.client import Job
from reproduce.context import SHORT, Context
from reproduce.sections import ENTRIES, bounds, by_sweep, by_type, mesh, methods, race, spectra, zone_plate

WITHOUT_BETA = {name: None for name in ("beta", "beta_i_max", "beta_i_mean", "edge_min", "edge_max")}
UNKNOWN = {"beta_upper": None, "r_f_lower": None, "r_c_upper": None}


def spacing_of(beta=0.8, **more):
    low, high = formulas.angle_bounds_deg(beta)
    return {"beta": beta, "r_f": 0.05, "r_c": 0.05 * beta, "beta_i_max": beta, "beta_i_mean": 0.7, "rho": 0.8,
            "coverage": 0.8 * beta, "r_f_free": 0.05, "cell_area_sd": 0.1, "angle_min_deg": low + 1, "angle_max_deg": high - 1,
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


def mesh_of(method):
    """A tetrahedron."""
    spread = {"min": 1.0, "mean": 1.0, "max": 1.0}
    which = "vertex_points" if method == "delaunay" else "face_points"
    return {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            which: [0, 1, 2, 3], "quality": {"faces": 4, "angle_deg": spread, "aspect_ratio": spread, "area": 1.0, "domain_area": 1.0}}


class FakeClient:
    """Answers whatever is asked for, of sets that have a beta or of such that have none."""

    def __init__(self, known):
        self.known = known

    def operations(self):
        damping = {"description": "Part of the move; default: as it likes"}
        return {"operations": [{"name": "optimize", "methods": [{"name": "opt-beta-local",
                                                                 "parameters": {"damping": damping}}]}]}

    def get(self, path):
        return b"<svg viewBox='0 0 1 1'></svg>"

    def job(self, operation, body):
        result = run_of() if self.known else run_without_beta()
        if operation == "analyze":
            groups = [group_of(group["label"], sets=group.get("seeds", 1)) for group in body["compare"]]
            if not self.known:
                groups = [without_beta(group) for group in groups]
            for group, asked in zip(groups, body["compare"]):
                if "generate" in asked["points"]:
                    del group["optimized"]
            result = {"compare": groups}
        if operation == "mesh":
            result = mesh_of(body["method"])
        return Job(self, "ID", operation, body, result)

    def upload(self, path):
        return {"id": "0" * 64, "faces": 4, "genus": 0}

    def timed(self, operation, body):
        return (run_of() if self.known else run_without_beta()), 0.5


def filled(entry, known):
    section = report.Section(entry.anchor, entry.title, 1)
    entry.fill(Context(FakeClient(known), SHORT), section)
    return section.html() + report.summary([section])


class NoBeta(unittest.TestCase):
    def test_every_section_is_written_whether_there_is_a_beta_or_not(self):
        for entry in ENTRIES:
            for known in (True, False):
                with self.subTest(entry.anchor, known=known):
                    page = filled(entry, known)
                    self.assertNotIn("None", page)
                    self.assertNotIn("nan", re.sub(r"<[^>]*>", " ", page).split())

    def test_nothing_that_is_not_known_is_said_to_hold(self):
        for fill in (bounds.fill, by_type.fill):
            entry = next(entry for entry in ENTRIES if entry.fill is fill)
            self.assertIn('class="holds"', filled(entry, True), entry.title)
            self.assertNotIn('class="holds"', filled(entry, False), entry.title)

    def test_a_span_says_how_many_values_are_missing(self):
        self.assertEqual(report.span([None, None]), report.number(None))
        self.assertEqual(report.span([0.7, None, 0.9], 1), "0.8 (0.7\u20130.9); 1 of 3 not available")

    def test_a_row_by_sweep_has_dashes_where_there_is_no_beta(self):
        group = without_beta(group_of("a", sets=1))
        self.assertEqual(by_sweep.row(group)[1:], [report.number(None)] * len(by_sweep.SWEEPS)
                         + ["1", report.number(None)])

    def test_what_has_no_beta_has_no_angle_bounds(self):
        self.assertEqual(formulas.angle_bounds_deg(None), (None, None))
        self.assertIsNone(formulas.all_bounds_hold(spacing_of() | WITHOUT_BETA))
        self.assertTrue(formulas.all_bounds_hold(spacing_of()))
        self.assertFalse(formulas.all_bounds_hold(spacing_of(edge_max=9)))

    def test_a_method_without_a_beta_has_not_reached_it_and_comes_last(self):
        slow, fast = race.Run("a", {}, run_of(0.84), [9.0], ""), race.Run("b", {}, run_without_beta(), [1.0], "")
        self.assertEqual(race.ordered([fast, slow]), [slow, fast])
        self.assertIn(report.number(None), race.row(fast, 0.1))

    def test_push_pull_is_left_out_where_opt_beta_gives_no_radii(self):
        self.assertIsNone(race.push_pull({"rho": None}))
        self.assertIsNone(race.push_pull({"rho": 0.0}))
        self.assertEqual(race.push_pull({"rho": 0.8}).parameters["rho"], 0.8)

    def test_the_least_beta_is_looked_for_among_those_that_have_one(self):
        groups = {label: group_of(label, beta) for label, beta in (("a", 0.8), ("b", 0.7))}
        groups["c"] = without_beta(group_of("c"))
        self.assertIn("least global beta is that of b", methods.why(groups))

    def test_spectra_without_oscillations_are_not_compared(self):
        groups = [group_of("opt-beta, beta 0.95"), group_of("opt-beta, beta 0.90")]
        job = types.SimpleNamespace(groups=[groups[0], without_beta(groups[1])])
        self.assertIn("0 of 1 targets", spectra.why(job, job))


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


class Sayings(unittest.TestCase):
    def test_the_default_damping_is_what_the_service_says(self):
        entry = next(entry for entry in ENTRIES if entry.fill is by_sweep.fill)
        self.assertIn("Without one given, damping is as it likes", filled(entry, True))

    def test_a_service_that_names_no_default_is_not_quoted(self):
        self.assertEqual(by_sweep.default_damping({"operations": []}), None)

    def test_settings_go_the_same_way_only_if_their_histories_do(self):
        def group(label, *betas):
            return {"label": label, "optimized": [{"history": [[k, beta, 1, 1] for k, beta in enumerate(betas)]}]}

        longer, shorter = group("a", 1, 0.9, 0.8), group("b", 1, 0.9)
        self.assertIn("go the same way, and stop earlier or later: a; b.",
                      by_sweep.same_way([longer, shorter, group("c", 1, 0.7)]))
        self.assertIn("part: a; b.", by_sweep.same_way([longer, group("b", 1, 0.9, 0.7)]))
        self.assertIn("No two", by_sweep.same_way([longer, group("c", 1, 0.7)]))

    def plates(self, lattice):
        return [group_of("MPS", rmse=0.1), group_of("CVT", rmse=0.2), group_of("square lattice", rmse=lattice)]

    def test_a_small_error_is_not_all_only_where_the_lattice_has_a_small_one(self):
        small, large = (zone_plate.story(self.plates(0.05), self.plates(lattice)) for lattice in (0.15, 0.3))
        self.assertIn("smaller than that of 1 of the 2 random sets", small)
        self.assertIn("false rings", small)
        self.assertNotIn("not all there is", large)
        self.assertIn("largest error", large)

    def test_the_smallest_angles_are_explained_only_if_the_nearest_method_stopped_at_its_target(self):
        far = group_of("MPS", 1.0, None)
        for spacing in far["spacing"]["by_set"]:
            spacing["angle_min_deg"] += 5
        stopped, past = group_of("opt-beta, beta 0.80", 0.7999), group_of("opt-beta, beta 0.80", 0.7)
        missed = group_of("opt-beta, beta 0.80", 0.8, False)
        self.assertIn("just as wanted", bounds.closest([far, stopped]))
        for group in (past, missed):
            self.assertIn("does not explain", bounds.closest([far, group]))
            self.assertNotIn("just as wanted has", bounds.closest([far, group]))

    def test_where_no_set_can_be_judged_nothing_is_said_of_the_nearest(self):
        self.assertIn("not available", bounds.closest([without_beta(group_of("a"))]))


if __name__ == "__main__":
    unittest.main()
