"""The pages and the reference, as far as they can be checked without building the site."""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "site"))

import headers  # noqa: E402
import hypertext  # noqa: E402
import reference  # noqa: E402


# What Python says otherwise, with shapes, None and its own names.
OWN_WORDS = {
    "Arc.first_state",
    "Arc.y",
    "Contact",
    "ContactForce.friction_used",
    "ContactForce.tangential",
    "ContactForce.torsion_moment",
    "Capacity.safe",
    "Cut.y",
    "Domain",
    "Grasp",
    "Harmonic2.slope",
    "InvalidGrasp",
    "LeastFriction.factor",
    "Load",
    "Objective.effort",
    "Pad",
    "Posture",
    "PostureCurve.states",
    "Tilt",
    "TurnPeak.posture",
    "TurnPeak.unholdable",
    "UnholdableArc",
    "Way.ups",
    "WeightEnd.dual",
    "WeightEnd.rates",
    "WeightEnd.weight",
    "all_loaded",
    "angle_of",
    "best_posture",
    "best_reachable",
    "bound",
    "capacity",
    "deciding",
    "deciding_drives",
    "drive_efforts",
    "finger_forces",
    "fork_wedge",
    "grasp_matrix",
    "grip",
    "hold",
    "least_friction",
    "least_grip",
    "manner",
    "phi",
    "posture_at",
    "posture_curve",
    "reason",
    "rectangular_pad",
    "shake",
    "smallest_turn",
    "tangents",
    "sturdiest_posture",
    "tilting",
    "up_at",
    "weight_range",
    "wrench_of",
    "best_offset",
    "WristOffset",
    "WristOffset.value",
    "Grasp.loads",
    "PathLimits.holdable",
    "PathLimits.inside",
    "PathLimits.rows",
    "PathLimits.shrunk",
    "SpeedLimit.bound",
    "SpeedLimit.factor",
    "SpeedLimit.state",
    "WristOffset.lower_bound",
    "WristOffset.now",
    "WristOffset.optimal",
    "WristOffset.rotation",
    "WristOffset.state",
    "domain_interval",
    "motion",
    "path_limits",
}


def plain(text):
    return " ".join(re.findall(r"[^\W_]+|[^\w\s.`]", text)).lower()


class Pages(unittest.TestCase):
    def test_links(self):
        self.assertEqual([dead for page in hypertext.pages() for dead in hypertext.dead_links(page)], [])

    def test_navigation(self):
        navigation = (ROOT / "site/.vitepress/config.mjs").read_text(encoding="utf-8")
        for page in (ROOT / "docs").glob("*.md"):
            if page.stem != "index":
                self.assertIn(f"link: '/{page.stem}'", navigation)


class Reference(unittest.TestCase):
    def test_everything_has_its_comment(self):
        pages = reference.cpp_pages()
        self.assertEqual(list(pages), ["index", *reference.reading_order()])

    def test_names_are_those_of_the_module(self):
        python = reference.Python()
        only_here = {name for name in python.stub if name in python.module.__all__} - set(python.places)
        own = {"Acronym", "BestPosture", "BestSpatialPosture", "Holds", "PlanarPosture", "Refutation"}
        own |= {"SpatialPosture", "Verdict", "answer_record", "best_many", "hold_many", "verify"}
        own |= {"PlanarTurn", "SpatialTurn", "PlanarReachable", "SpatialReachable", "turn", "Motion"}
        self.assertEqual(only_here, own | {"with_friction", "with_weight", "without_limits"})
        text = python.page()
        for name in python.module.__all__:
            self.assertEqual(len(re.findall(rf"^### {name}$", text, re.MULTILINE)), 1, name)

    def test_docstrings_are_the_comments_of_the_headers(self):
        twins = list(reference.Python().twins())
        self.assertGreater(len(twins), 100)
        own = {name for name, words, comment in twins if plain(words) != plain(comment)}
        self.assertEqual(own, OWN_WORDS)

    def test_all_of_a_header_is_read(self):
        """Its names found by another way: what begins in the first column."""
        for file in reference.HEADERS.glob("*.hpp"):
            plain = re.sub(r"//.*", "", file.read_text(encoding="utf-8"))
            read = {each.name.split("<")[0] for each in headers.read(file).declarations}
            found = {
                name
                for pattern in [
                    r"^(?:struct|class|enum class) (\w+)",
                    r"^using (\w+)",
                    r"^(?=\w)[\w:<>,& *]+?[ *&](\w+)\(",
                    r"^inline constexpr \w+ (\w+)",
                ]
                for name in re.findall(pattern, plain, re.MULTILINE)
            }
            self.assertEqual(read, found, file.name)

    def test_damage_is_seen(self):
        whole = (reference.HEADERS / "grasp.hpp").read_text(encoding="utf-8")
        for damaged in [
            whole.replace("class Grasp : public Hand<Dim> {", "class Grasp : public Hand<Dim> { (", 1),
            whole.replace("}  // namespace poise", "}"),
            whole.replace("#pragma once\n", "#pragma once\n#define X 1\n"),
            whole.replace("/// A hand with what", "\n/// Lost.\n\n/// A hand with what"),
        ]:
            self.assertNotEqual(damaged, whole)
            with self.assertRaises(headers.Unread):
                headers.parse("grasp", damaged)
        silent = whole.replace("  /// The size of the largest load [N].\n", "")
        self.assertEqual(
            headers.silent(headers.parse("grasp", silent)),
            ["grasp.hpp:29: Grasp::size has no comment"],
        )


class Hypertext(unittest.TestCase):
    def test_anchors_are_those_of_github(self):
        text = "# A `b` c, d!\n## A b c d\n```\n# no\n```\n### Ω and 2×2 [x](y.md)\n"
        self.assertEqual(hypertext.anchors(text), ["a-b-c-d", "a-b-c-d-1", "ω-and-22-x"])

    def test_links_in_listings_are_none(self):
        text = "[a](b.md) `[c](d.md)` $[e](f)$\n```\n[g](h.md)\n```\n[![i](j.png)](k.md#l)\n"
        self.assertEqual([link.target for link in hypertext.links(text)], ["b.md", "j.png", "k.md#l"])
        changed = hypertext.relinked(text, lambda target: "x/" + target)
        self.assertIn("[![i](x/j.png)](x/k.md#l)", changed)
        self.assertIn("`[c](d.md)`", changed)


if __name__ == "__main__":
    unittest.main()
