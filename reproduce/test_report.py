"""Tests of what needs no server. python3 -m unittest reproduce.test_report"""

import json
import math
import shlex
import unittest

from reproduce import bodies, chart, check, formulas, paper, report, server
from reproduce.client import Client, Job, Picture, Problem, problem_document
from reproduce.sections import ENTRIES


def spacing_of(beta, angle_min, angle_max, edge_max, edge_min=1.0):
    return {"beta": beta, "angle_min_deg": angle_min, "angle_max_deg": angle_max, "edge_min": edge_min,
            "edge_max": edge_max}


class Formulas(unittest.TestCase):
    def test_the_triangular_lattice_has_angles_of_sixty_degrees_only(self):
        low, high = formulas.angle_bounds_deg(formulas.TRIANGULAR)
        self.assertAlmostEqual(low, 60)
        self.assertAlmostEqual(high, 60)

    def test_mps_has_angles_from_thirty_to_a_hundred_and_twenty_degrees(self):
        low, high = formulas.angle_bounds_deg(1)
        self.assertAlmostEqual(low, 30)
        self.assertAlmostEqual(high, 120)

    def test_no_bound_is_made_up_for_what_no_point_set_has(self):
        with self.assertRaises(ValueError):
            formulas.angle_bounds_deg(0.49)

    def test_obtuse_triangles_are_ruled_out_below_the_square_lattice_only(self):
        self.assertTrue(formulas.no_obtuse_triangle(0.707))
        self.assertFalse(formulas.no_obtuse_triangle(formulas.SQUARE))
        self.assertLess(formulas.angle_bounds_deg(0.707)[1], 90)

    def test_the_square_lattice_is_at_its_bounds_and_within_them(self):
        square = spacing_of(formulas.SQUARE, 45 - 1e-13, 90, math.sqrt(2))
        self.assertTrue(all(formulas.bounds_hold(square).values()))

    def test_each_bound_is_seen_to_be_broken(self):
        fine = {"beta": 0.7, "angle_min": 46, "angle_max": 88, "edge_max": 1.39}
        self.assertTrue(all(formulas.bounds_hold(spacing_of(**fine)).values()))
        broken = {"smallest angle": {"angle_min": 45}, "largest angle": {"angle_max": 89},
                  "longest edge": {"edge_max": 1.41}, "shortest edge": {"edge_min": 0.99},
                  "no obtuse triangle": {"angle_max": 91}}
        for name, change in broken.items():
            self.assertFalse(formulas.bounds_hold(spacing_of(**(fine | change)))[name], name)

    def test_the_least_rho_is_that_of_the_triangular_lattice(self):
        self.assertAlmostEqual(formulas.least_rho(formulas.TRIANGULAR), 1)

    def test_the_spacing_of_the_triangular_lattice_gives_back_its_area(self):
        n = 1024
        self.assertAlmostEqual(n * formulas.d_hex(2.0, n)**2 * math.sqrt(3) / 2, 2.0)

    def test_shares_add_up_to_one_and_are_in_order(self):
        self.assertEqual(formulas.shares({"10": 1, "5": 1, "6": 2}), {5: 0.25, 6: 0.5, 10: 0.25})
        self.assertEqual(list(formulas.shares({"10": 1, "5": 1})), [5, 10])

    def test_the_first_sweep_at_a_target_is_the_first_and_not_the_last(self):
        history = [[0, 1.0, 1, 1], [1, None, 1, 1], [4, 0.84, 1, 1], [5, 0.86, 1, 1], [6, 0.83, 1, 1]]
        self.assertEqual(formulas.first_sweep_at(history, 0.85), 4)
        self.assertIsNone(formulas.first_sweep_at(history, 0.8))

    def test_beta_after_a_sweep_is_that_of_the_last_one_recorded(self):
        history = [[0, 1.0, 1, 1], [4, 0.84, 1, 1]]
        self.assertEqual(formulas.beta_after(history, 3), 1.0)
        self.assertEqual(formulas.beta_after(history, 4), 0.84)
        self.assertIsNone(formulas.beta_after(history, 5))

    def test_median_and_range(self):
        self.assertEqual(formulas.median_and_range([3, 1, 2, 10]), (2.5, 1, 10))

    def test_rounding_down_never_goes_up(self):
        self.assertEqual(formulas.floor_to(0.82939, 4), 0.8293)


class Text(unittest.TestCase):
    def test_whatever_is_text_is_escaped(self):
        self.assertEqual(report.escape("<b> & \"quotes\""), "&lt;b&gt; &amp; &quot;quotes&quot;")
        self.assertNotIn("<script", report.table("<script>", ["<script>"], [["<script>"]]))

    def test_html_is_left_alone(self):
        self.assertEqual(report.escape(report.Html("<b>")), "<b>")

    def test_symbols_get_their_subscripts(self):
        self.assertEqual(report.escape("r_f, d_hex and beta_i"), "r<sub>f</sub>, d<sub>hex</sub> and "
                                                                 "beta<sub>i</sub>")
        self.assertEqual(report.escape("r_f\u00b2"), "r<sub>f</sub>\u00b2")
        self.assertEqual(report.escape("beta_i_max and `r_f`"), "beta_i_max and <code>r_f</code>")

    def test_numbers_keep_their_digits_and_what_is_missing_is_a_dash(self):
        self.assertEqual(report.number(0.7), "0.700")
        self.assertEqual(report.number(-10, 1), "\u221210.0")
        self.assertEqual(report.number(None), "\u2013")

    def test_a_span_of_one_value_is_that_value(self):
        self.assertEqual(report.span([0.7, 0.7]), "0.700")
        self.assertEqual(report.span([0.7, 0.9], 1), "0.8 (0.7\u20130.9)")

    def test_verdicts_follow_from_the_condition(self):
        self.assertIn("holds", report.holds(True))
        self.assertIn("FAILS", report.holds(False))
        self.assertIn("DIFFERS", report.agrees(False))

    def test_a_row_of_another_length_is_refused(self):
        with self.assertRaises(ValueError):
            report.table("", ["a", "#b"], [["only one"]])

    def test_columns_of_numbers_are_set_to_the_right(self):
        self.assertIn('<td class="number">1.5</td>', report.table("", ["a", "#b"], [["x", "1.5"]]))

    def test_a_drawing_says_what_it_shows(self):
        self.assertIn('aria-label="a &lt; b"', report.drawing(Picture("svg", b"<svg x='1'></svg>"), "a < b"))
        png = report.drawing(Picture("png", b"bytes"), "a < b")
        self.assertIn('alt="a &lt; b"', png)
        self.assertIn("data:image/png;base64,", png)


class Requests(unittest.TestCase):
    def test_a_comparison_holds_generated_and_optimized_points(self):
        start = bodies.mps(100, seed=7)
        body = bodies.comparison([bodies.group("MPS", start, 3),
                                  bodies.group("CVT", bodies.optimized(start, "cvt", max_sweeps=5))], ["spacing"])
        generate = {"generate": {"method": "poisson-disk", "count": 100, "seed": 7}}
        self.assertEqual(body, {
            "compare": [
                {"label": "MPS", "points": generate, "seeds": 3},
                {"label": "CVT", "points": {"optimize": {"points": generate, "method": "cvt", "max_sweeps": 5}}}],
            "measures": ["spacing"]})

    def test_what_the_service_would_refuse_is_refused_before(self):
        with self.assertRaises(ValueError):
            bodies.group("x" * 61, bodies.mps(3))
        with self.assertRaises(ValueError):
            bodies.comparison([], ["spacing"])
        with self.assertRaises(ValueError):
            bodies.comparison([bodies.group("", bodies.mps(3))] * 17, ["spacing"])

    def test_lattices_take_no_seed(self):
        self.assertNotIn("seed", bodies.generated("square", 4)["generate"])

    def test_a_picture_is_asked_for_by_query(self):
        self.assertEqual(bodies.picture_query("voronoi", "png", {"size_px": 240}),
                         "format=png&picture=voronoi&picture.size_px=240")

    def test_a_shell_reads_the_command_as_it_was_meant(self):
        body = {"label": "it's \"quoted\""}
        words = shlex.split(bodies.curl("/v1/analyze", body, respond_async=True))
        self.assertEqual(json.loads(words[-1]), body)
        self.assertIn("Prefer: respond-async", words)


class Refusals(unittest.TestCase):
    def test_a_problem_shows_all_that_its_document_says(self):
        problem = Problem({"title": "Not possible", "status": 422, "detail": "beta is too low",
                           "errors": [{"pointer": "/beta", "detail": "below the floor"}]}, "POST /v1/optimize")
        for text in ("Not possible", "422", "beta is too low", "/beta", "below the floor", "POST /v1/optimize"):
            self.assertIn(text, str(problem))

    def test_an_answer_that_is_no_problem_document_is_shown_as_it_is(self):
        self.assertEqual(problem_document(b"Bad Gateway", 502)["detail"], "Bad Gateway")
        self.assertEqual(problem_document(b"[1]", 502)["status"], 502)

    def test_an_address_where_nobody_listens_is_said(self):
        with self.assertRaises(Problem) as raised:
            Client("http://127.0.0.1:1").operations()
        self.assertIn("/v1/operations", str(raised.exception))

    def test_the_address_of_a_server_is_in_its_log(self):
        log = 'starting\n{"message":"other","listen":"x"}\n{"message":"serving","listen":"127.0.0.1:4711"}\n'
        self.assertEqual(server.address_in(log), "http://127.0.0.1:4711")
        self.assertIsNone(server.address_in("starting\n{\"mess"))

    def test_settings_for_other_servers_are_left_out(self):
        environment = {"PATH": "/bin", "WELLSPACED_LISTEN": "0.0.0.0:80"}
        self.assertEqual(server.own_environment(environment), {"PATH": "/bin"})

    def test_a_server_that_does_not_start_is_reported_with_what_it_said(self):
        with self.assertRaises(server.ServerFailed) as raised:
            with server.running("/bin/false"):
                self.fail("it can't serve")
        self.assertIn("/bin/false", str(raised.exception))


class Pictures(unittest.TestCase):
    def job(self, svg_bytes, png_bytes):
        class Fake:
            def get(self, path):
                return b"x" * (svg_bytes if "format=svg" in path else png_bytes)

        return Job(Fake(), "id", "analyze", {}, {})

    def test_a_small_picture_is_svg(self):
        self.assertEqual(self.job(1000, 10).picture("voronoi").kind, "svg")

    def test_a_large_one_is_png_if_that_is_smaller_in_the_page(self):
        self.assertEqual(self.job(2_000_000, 1_000_000).picture("voronoi").kind, "png")
        self.assertEqual(self.job(2_000_000, 1_600_000).picture("voronoi").kind, "svg")

    def test_the_commands_name_the_picture_that_was_taken(self):
        job = self.job(2_000_000, 1_000_000)
        job.picture("voronoi", size_px=240)
        self.assertIn("format=png&picture=voronoi&picture.size_px=240&picture.scale=2' -o voronoi.png", job.curl())


class Page(unittest.TestCase):
    def page(self):
        sections = []
        for number, entry in enumerate(ENTRIES, 1):
            section = report.Section(entry.anchor, entry.title, number)
            section.text("what it is about")
            section.table("numbers", ["a"], [["1"]])
            section.figure(Picture("svg", b"<svg viewBox='0 0 1 1'><path d='M0 0'/></svg>"), "a figure", "instead")
            section.finding("what", "the paper", "ours", report.holds(True))
            section.requests("curl")
            sections.append(section)
        return report.page("A title", report.paragraph("lead"), sections, [("total", "1 s")])

    def wanted(self):
        return {entry.anchor: entry.has for entry in ENTRIES} | {"summary": ("table",)}

    def test_a_whole_page_has_no_faults(self):
        self.assertEqual(check.faults(self.page(), self.wanted()), [])

    def test_it_says_its_language_and_needs_nothing_from_outside(self):
        page = self.page()
        self.assertIn('<html lang="en">', page)
        self.assertNotIn("<script", page)
        self.assertNotIn("@import", page)

    def test_a_missing_section_is_a_fault(self):
        page = self.page().replace('id="mesh"', 'id="mess"')
        self.assertIn("the section mesh is missing", check.faults(page, self.wanted()))

    def test_a_section_without_its_figure_is_a_fault(self):
        self.assertEqual(check.faults('<section id="a"><table></table></section>', {"a": ("table", "figure")}),
                         ["the section a has no figure"])

    def test_what_is_fetched_from_elsewhere_is_a_fault(self):
        for text in ('<img alt="x" src="http://example.org/x.png">', '<link href="style.css">', "<script></script>",
                     "<p>", "<p></div>", '<p id="a"></p><p id="a"></p>', '<img src="data:x">'):
            self.assertTrue(check.faults(text, {}), text)


class Charts(unittest.TestCase):
    def test_ticks_are_round_and_within_the_axis(self):
        ticks, step = chart.Axis("beta", 0.66, 1.02).ticks()
        self.assertEqual([round(tick, 6) for tick in ticks], [0.7, 0.8, 0.9, 1.0])
        self.assertEqual(step, 0.1)

    def test_higher_values_are_drawn_higher(self):
        panel = chart.Chart("t", chart.Axis("x", 0, 1), chart.Axis("y", 0, 1), [chart.Series("a", [(0, 0), (1, 1)])])
        panel.svg()
        (x0, y0), (x1, y1) = panel._px(0, 0), panel._px(1, 1)
        self.assertTrue(x1 > x0 and y1 < y0)

    def test_labels_are_escaped(self):
        panel = chart.Chart("<t>", chart.Axis("<x>", 0, 1), chart.Axis("<y>", 0, 1), [chart.Series("<a>", [(0, 0)])])
        svg = chart.side_by_side([panel], "<all>").data.decode()
        for text in ("<t>", "<x>", "<y>", "<a>", "<all>"):
            self.assertNotIn(text, svg)


class Paper(unittest.TestCase):
    def test_every_statement_names_its_source(self):
        statements = [value for value in vars(paper).values() if isinstance(value, paper.Statement)]
        self.assertTrue(statements)
        for statement in statements:
            self.assertIn(f"[{statement.source}]", str(statement))
            self.assertTrue("abstract" in statement.source or "project notes" in statement.source)


if __name__ == "__main__":
    unittest.main()
