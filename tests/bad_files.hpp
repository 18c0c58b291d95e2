// Grasp files that must be refused, and the words for it.
#pragma once

#include <string>
#include <vector>

namespace poise {

struct BadFile {
  std::string name, text;
  std::string message;  ///< what follows "FILE:"
};

inline const std::vector<BadFile> bad_files{
    // The text.
    {"empty", "", " is empty, must be a grasp file"},
    {"only a comment", "# nothing\n", " is empty, must be a grasp file"},
    {"a list",
     "- 1\n"
     "- 2\n",
     "1:1: is a list of 2, must be a mapping"},
    {"a number", "42\n", "1:1: is 42, must be a mapping"},
    {"a line of text", "hold this\n", "1:1: is \"hold this\", must be a mapping"},
    {"two documents",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "---\n"
     "poise: 1\n",
     "6:1: a second document begins here, must be one"},
    {"bracket not closed",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:32: is not YAML: illegal flow end"},
    {"quote not closed",
     "poise: 1\n"
     "dimension: 2\n"
     "name: \"disk\n",
     "3:12: is not YAML: illegal EOF in scalar"},
    {"JSON not closed", "{\"poise\": 1, \"dimension\": 2",
     "1:28: is not YAML: end of map flow not found"},
    {"indented by a tab",
     "poise: 1\n"
     "dimension: 2\n"
     "object:\n"
     "\tweight: 10\n"
     "\tcom: [0, 0]\n",
     "4:8: is not YAML: illegal map value (the line is indented by a tab)"},
    {"unknown escape",
     "poise: 1\n"
     "name: \"a\\q\"\n",
     "2:11: is not YAML: unknown escape character: q"},
    {"no UTF-8",
     "poise: 1\n"
     "name: d\351j\340\n",
     "2:8: is not UTF-8 text"},
    {"UTF-16", std::string("\377\376p\000o\000i\000s\000e\000:\000 \0001\000\n\000", 20),
     "1:1: is not UTF-8 text"},
    {"NUL", std::string("poise: 1\nname: \000\n", 17), "2:7: is a control character, must be text"},
    {"unknown alias",
     "poise: 1\n"
     "dimension: 2\n"
     "name: *nobody\n",
     "3:7: is not YAML: the referenced anchor is not defined"},
    {"alias of itself", "poise: &a [*a]\n", "1:12: an alias within the value that it stands for"},
    {"nested too deeply",
     "poise: 1\n"
     "dimension: 2\n"
     "name: [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]\n",
     "3:39: is nested too deeply"},
    {"alias bomb",
     "a: &a [x, x, x, x, x, x, x, x, x, x]\n"
     "b: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a, *a]\n"
     "c: &c [*b, *b, *b, *b, *b, *b, *b, *b, *b, *b]\n"
     "d: &d [*c, *c, *c, *c, *c, *c, *c, *c, *c, *c]\n"
     "e: &e [*d, *d, *d, *d, *d, *d, *d, *d, *d, *d]\n"
     "f: &f [*e, *e, *e, *e, *e, *e, *e, *e, *e, *e]\n"
     "g: &g [*f, *f, *f, *f, *f, *f, *f, *f, *f, *f]\n",
     "6:32: too many values, once aliases are written out"},
    {"merge key",
     "poise: 1\n"
     "dimension: 2\n"
     "base: &base {weight: 10}\n"
     "object: {<<: *base, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "4:10: merge keys are not part of YAML 1.2, write the keys out"},
    {"key that is a list",
     "poise: 1\n"
     "dimension: 2\n"
     "? [name]\n"
     ": disk\n",
     "3:3: is a key, must be text"},
    {"tag", "poise: !version 1\n", "1:8: has the tag !version, must have none"},
    // The top.
    {"no version",
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "1:1: poise: is missing, must be 1, the version of this format"},
    {"a result", "{\"poise_result\": 1, \"command\": \"best\"}\n",
     "1:1: is a result, must be the grasp file that it is of"},
    {"newer version",
     "poise: 2\n"
     "plan: all\n",
     "1:8: poise: is 2, this program reads 1: a newer one is needed"},
    {"version is text", "poise: \"1\"\n", "1:8: poise: is \"1\", must be a number"},
    {"version below 1", "poise: 0.5\n", "1:8: poise: is 0.5, must be 1"},
    {"no dimension",
     "poise: 1\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "1:1: dimension: is missing, must be 2 (the plane) or 3 (space)"},
    {"dimension 4",
     "poise: 1\n"
     "dimension: 4\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "2:12: dimension: is 4, must be 2 (the plane) or 3 (space)"},
    {"unknown key",
     "poise: 1\n"
     "dimension: 2\n"
     "saftey: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:1: saftey: is not a known key, the nearest is safety"},
    {"key given twice",
     "poise: 1\n"
     "dimension: 2\n"
     "safety: 2\n"
     "name: disk\n"
     "safety: 3\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "5:1: safety: is given twice, first in line 3"},
    {"name is a number",
     "poise: 1\n"
     "dimension: 2\n"
     "name: 12\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:7: name: is 12, must be text: put it in quotes"},
    {"name of two lines",
     "poise: 1\n"
     "dimension: 2\n"
     "name: |\n"
     "  a\n"
     "  b\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:7: name: is \"a?b?\", must be one line of text without control characters"},
    {"safety below 1",
     "poise: 1\n"
     "dimension: 2\n"
     "safety: 0.5\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:9: safety: is 0.5, must be at least 1"},
    {"safety is yes",
     "poise: 1\n"
     "dimension: 2\n"
     "safety: yes\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:9: safety: is \"yes\", must be a number"},
    {"angle not finite",
     "poise: 1\n"
     "dimension: 2\n"
     "angle_deg: .nan\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:12: angle_deg: is nan, must be a finite number"},
    {"angle is text",
     "poise: 1\n"
     "dimension: 2\n"
     "angle_deg: 30deg\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:12: angle_deg: is \"30deg\", must be a number"},
    {"unknown domain",
     "poise: 1\n"
     "dimension: 2\n"
     "domain: cradled\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:9: domain: is \"cradled\", must be all or pinching-up"},
    {"unknown unit",
     "poise: 1\n"
     "dimension: 2\n"
     "length_unit: km\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:14: length_unit: is \"km\", must be m, cm, mm or in"},
    {"unknown direction of normals",
     "poise: 1\n"
     "dimension: 2\n"
     "normals: outwards\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:10: normals: is \"outwards\", must be inward or outward"},
    {"up in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "up: [0, 0, 1]\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:1: up: belongs to space (dimension 3), not to the plane"},
    {"tilt in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "tilt: {from: [0, 0, 1], max_deg: 30}\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:1: tilt: belongs to space (dimension 3), not to the plane"},
    {"value missing",
     "poise: 1\n"
     "dimension: 2\n"
     "safety:\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:1: safety: is empty, must be a number"},
    // The object.
    {"no object",
     "poise: 1\n"
     "dimension: 2\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "1:1: object: is missing, must be a mapping"},
    {"object is a number",
     "poise: 1\n"
     "dimension: 2\n"
     "object: 10\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:9: object: is 10, must be a mapping (keys: weight, mass, com, shape)"},
    {"unknown key of the object",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {wieght: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:10: object.wieght: is not a known key, the nearest is weight"},
    {"object key given twice",
     "poise: 1\n"
     "dimension: 2\n"
     "object:\n"
     "  weight: 10\n"
     "  com: [0, 0]\n"
     "  weight: 10\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "6:3: object.weight: is given twice, first in line 4"},
    {"neither weight nor mass",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:9: object.weight: is missing, must be a force [N], or give mass [kg]"},
    {"weight and mass",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, mass: 1, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:28: object.mass: is given as well as weight, must be one of them"},
    {"weight 0",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 0, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:18: object.weight: is 0, must be above 0 where nothing else acts"},
    {"weight with a unit",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10 N, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:18: object.weight: is \"10 N\", must be a number"},
    {"weight in JSON is text",
     "{\"poise\": 1, \"dimension\": 2,\n"
     " \"object\": {\"weight\": \"10\", \"com\": [0, 0]}, \"contacts\": []}\n",
     "2:23: object.weight: is \"10\", must be a number"},
    {"weight infinite",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: .inf, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:18: object.weight: is inf, must be a finite number"},
    {"weight beyond doubles",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 1e400, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:18: object.weight: is inf, must be a finite number"},
    {"square of the weight overflows",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 1e200, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:18: object.weight: is 1e+200, must be within 1.3e154, or its square overflows"},
    {"negative mass",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {mass: -1, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:16: object.mass: is -1, must be at least 0"},
    {"neither com nor shape",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:9: object.com: is missing, must be [x, y], as there is no shape"},
    {"com of three numbers",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:27: object.com: is a list of 3, must be [x, y]"},
    {"com with a comma as decimal point",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0,5, 0,5]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:27: object.com: is a list of 4, must be [x, y]"},
    {"com of text",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, left]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:31: object.com[1]: is \"left\", must be a number"},
    {"com too long",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [1.3e154, 1.3e154]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:27: object.com: is too long, its square overflows"},
    {"scenarios in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {scenarios: [{weight: 1, com: [0, 0]}]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:21: object.scenarios: is not known any more, must be `loads` of the file: a list of {name, "
     "mass, com}"},
    // The shape.
    {"unknown shape",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {circle: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:30: object.shape.circle: is not a known key, the nearest is disk"},
    {"two shapes",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {disk: {radius: 1}, ellipse: {radii: [1, 1]}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:29: object.shape: has 2 kinds, must have one: disk, ellipse or polygon"},
    {"no shape",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:29: object.shape: has 0 kinds, must have one: disk, ellipse or polygon"},
    {"shape of space",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {mesh: cup.stl}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:30: object.shape.mesh: belongs to space (dimension 3), not to the plane"},
    {"disk without radius",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {disk: {}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:36: object.shape.disk.radius: is missing, must be a length"},
    {"disk of a number",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {disk: 1}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:36: object.shape.disk: is 1, must be a mapping (keys: radius)"},
    {"radius 0",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {disk: {radius: 0}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:45: object.shape.disk.radius: is 0, must be above 0"},
    {"radius too small",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {disk: {radius: 1e-300}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:45: object.shape.disk.radius: is 1e-300, too small to compute with"},
    {"ellipse with one radius",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {ellipse: {radii: [1]}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:47: object.shape.ellipse.radii: is a list of 1, must be [x, y]"},
    {"negative radius",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {ellipse: {radii: [1, -1]}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:51: object.shape.ellipse.radii[1]: is -1, must be above 0"},
    {"needle",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {ellipse: {radii: [1, 1e-9]}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:47: object.shape.ellipse.radii: are 1 and 1e-09, one must be at most 1e6 times the other"},
    {"two vertices",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [1, 0]]}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:39: object.shape.polygon: has 2 vertices, must have 3 to 10000"},
    {"a vertex of one number",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [1, 0], [1]]}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:56: object.shape.polygon[2]: is a list of 1, must be [x, y]"},
    {"edges cross",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [1, 1], [1, 0], [0, 1]]}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:39: object.shape.polygon: edges 0 and 2 cross or touch, an outline must not touch itself"},
    {"edges fold back",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [2, 0], [1, 0], [1, 1]]}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:39: object.shape.polygon: edges 0 and 1 fold back on each other, an outline must not touch "
     "itself"},
    {"first vertex repeated",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [1, 0], [1, 1], [0, 0]]}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:39: object.shape.polygon: edge 3, from vertex 3 to vertex 0, has no length: a vertex is "
     "given twice"},
    {"outline touches itself",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [2, 0], [2, 2], [1, 0], [0, 2]]}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:39: object.shape.polygon: edges 0 and 2 cross or touch, an outline must not touch itself"},
    {"contact off the shape",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {disk: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [0.9, 0], friction: 1}\n",
     "5:16: contacts[0].position: is 0.1 m from the boundary of the shape, must be within 0.0001 m "
     "of it, or give the normal"},
    {"contact at a corner",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {polygon: [[0, 0], [1, 0], [1, 1], [0, 1]]}}\n"
     "contacts:\n"
     "  - {position: [1, 1], friction: 1}\n",
     "5:16: contacts[0].position: is at the corner between edges 1 and 2 of the polygon, give the "
     "normal"},
    // The contacts.
    {"contacts missing",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n",
     "1:1: contacts: is missing, must be a list"},
    {"no contacts",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts: []\n",
     "4:11: contacts: is empty, must hold at least one contact"},
    {"contacts are a mapping",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts: {left: 1}\n",
     "4:11: contacts: is a mapping, must be a list"},
    {"contact is a number",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts: [1]\n",
     "4:12: contacts[0]: is 1, must be a mapping (keys: position, normal, friction, min_normal, "
     "max_normal, share, finger, pad, adhesion)"},
    {"no position",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {normal: [1, 0], friction: 1}\n",
     "6:5: contacts[1].position: is missing, must be [x, y]"},
    {"position of one number",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [1], normal: [1, 0], friction: 1}\n",
     "6:16: contacts[1].position: is a list of 1, must be [x, y]"},
    {"position of three numbers",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0], friction: 1}\n",
     "6:16: contacts[1].position: is a list of 3, must be [x, y]"},
    {"position not finite",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [.inf, 0], normal: [1, 0], friction: 1}\n",
     "6:17: contacts[1].position[0]: is inf, must be a finite number"},
    {"no normal, no shape",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], friction: 1}\n",
     "6:5: contacts[1].normal: is missing, must be [x, y], as there is no shape"},
    {"normal without length",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [0, 0], friction: 1}\n",
     "6:33: contacts[1].normal: has no length, must point from the finger inwards"},
    {"no friction",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0]}\n",
     "6:5: contacts[1].friction: is missing, must be a number"},
    {"negative friction",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: -1}\n",
     "6:51: contacts[1].friction: is -1, must be at least 0"},
    {"unknown key of a contact",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], fricton: 1}\n",
     "6:41: contacts[1].fricton: is not a known key, the nearest is friction"},
    {"contact key given twice",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - position: [1, 0]\n"
     "    normal: [1, 0]\n"
     "    friction: 1\n"
     "    friction: 2\n",
     "8:5: contacts[0].friction: is given twice, first in line 7"},
    {"torsion in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, torsion: 0.01}\n",
     "6:54: contacts[1].torsion: belongs to space (dimension 3), not to the plane"},
    {"negative min_normal",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, min_normal: -2}\n",
     "6:66: contacts[1].min_normal: is -2, must be at least 0"},
    {"max_normal below min_normal",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, min_normal: 2, max_normal: 1}\n",
     "6:81: contacts[1].max_normal: is 1, must be at least min_normal, 2"},
    {"max_normal infinite",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, max_normal: .inf}\n",
     "6:66: contacts[1].max_normal: is inf, must be a finite number"},
    {"share 0",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, share: 0}\n",
     "6:61: contacts[1].share: is 0, must be above 0 and at most 1"},
    {"share above 1",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, share: 1.5}\n",
     "6:61: contacts[1].share: is 1.5, must be above 0 and at most 1"},
    {"finger is a number",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, finger: 2}\n",
     "6:62: contacts[1].finger: is 2, must be text: put it in quotes"},
    {"finger is empty",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, finger: \"\"}\n",
     "6:62: contacts[1].finger: is \"\", must be text"},
    {"finger with a control character",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n"
     "  - {position: [-1, 0], normal: [1, 0], friction: 1, finger: \"a\\eb\"}\n",
     "6:62: contacts[1].finger: is \"a?b\", must be one line of text without control characters"},
    // Space.
    {"angle in space",
     "poise: 1\n"
     "dimension: 3\n"
     "angle_deg: 30\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:1: angle_deg: belongs to the plane (dimension 2), not to space"},
    {"pinched in space",
     "poise: 1\n"
     "dimension: 3\n"
     "domain: pinching-up\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:9: domain: pinching-up is for the plane, must be all: best_pinched is shown anyway"},
    {"unknown domain in space",
     "poise: 1\n"
     "dimension: 3\n"
     "domain: any\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:9: domain: is \"any\", must be all or pinching-up"},
    {"up of two numbers",
     "poise: 1\n"
     "dimension: 3\n"
     "up: [0, 1]\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:5: up: is a list of 2, must be [x, y, z]"},
    {"up without length",
     "poise: 1\n"
     "dimension: 3\n"
     "up: [0, 0, 0]\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:5: up: has no length, must be a direction"},
    {"up not finite",
     "poise: 1\n"
     "dimension: 3\n"
     "up: [0, .nan, 1]\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:9: up[1]: is nan, must be a finite number"},
    {"tilt is a number",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: 30\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:7: tilt: is 30, must be a mapping (keys: max_deg, from)"},
    {"tilt from nowhere",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: {max_deg: 30}\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:7: tilt.from: is missing, must be [x, y, z]"},
    {"tilt from no direction",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: {from: [0, 0, 0], max_deg: 30}\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:14: tilt.from: has no length, must be a direction"},
    {"tilt without angle",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: {from: [0, 0, 1]}\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:7: tilt.max_deg: is missing, must be an angle in degrees"},
    {"tilt beyond the horizontal",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: {from: [0, 0, 1], max_deg: 90.5}\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:34: tilt.max_deg: is 90.5, must be from 0 to 90"},
    {"negative tilt",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: {from: [0, 0, 1], max_deg: -1}\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:34: tilt.max_deg: is -1, must be from 0 to 90"},
    {"unknown key of tilt",
     "poise: 1\n"
     "dimension: 3\n"
     "tilt: {from: [0, 0, 1], max: 30}\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:25: tilt.max: is not a known key, the nearest is max_deg"},
    {"com of two numbers",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:27: object.com: is a list of 2, must be [x, y, z]"},
    {"neither com nor solid",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:9: object.com: is missing, must be [x, y, z], as there is no shape"},
    {"no loads",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: []\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:8: loads: is empty, must hold at least one load"},
    {"loads are a mapping",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: {weight: 1}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:8: loads: is a mapping, must be a list"},
    {"a load without weight",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {com: [0, 0, 0]}\n"
     "loads: [{weight: 1}, {name: b}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:22: loads[1].weight: is missing, must be a force [N], or give mass [kg]"},
    {"a load without com",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1}\n"
     "loads: [{com: [0, 0, 0]}, {mass: 1}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:27: loads[1].com: is missing, must be [x, y, z], as there is no shape"},
    {"a load of negative weight",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{weight: -1}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:18: loads[0].weight: is -1, must be at least 0"},
    {"nothing acts",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{weight: 0}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:18: loads[0].weight: is 0, must be above 0 where nothing else acts"},
    {"a load with a shape",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{shape: {sphere: {radius: 1}}}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:10: loads[0].shape: is not a known key, the nearest is name"},
    {"a load with twice a weight",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{weight: 1, mass: 1}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:27: loads[0].mass: is given as well as weight, must be one of them"},
    {"a place without a force",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{at: [1, 0, 0]}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:14: loads[0].at: is given without a force, must be left out"},
    {"a moment of the plane",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{moment: 1}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:18: loads[0].moment: is 1, must be [x, y, z]"},
    {"an acceleration without a number",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{acceleration: {}}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:24: loads[0].acceleration: is empty, must have up, any or fixed [m/s2], or be [x, y, z]"},
    {"an acceleration in no direction",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{acceleration: {any: 0}}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:30: loads[0].acceleration.any: is 0, must be above 0"},
    {"an acceleration down",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{acceleration: {down: 3}}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:25: loads[0].acceleration.down: is not a known key, the nearest is up"},
    {"an acceleration of nothing",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 0, com: [0, 0, 0]}\n"
     "loads: [{acceleration: {any: 1}, force: [1, 0, 0]}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:24: loads[0].acceleration: is of an object without mass, must be left out"},
    {"nothing in one of the loads",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "loads: [{acceleration: {any: 1}}, {weight: 0}]\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "4:44: loads[1].weight: is 0, must be above 0 where nothing else acts"},
    {"shape of the plane",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {disk: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:30: object.shape.disk: belongs to the plane (dimension 2), not to space"},
    {"two solids",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {box: {size: [1, 1, 1]}, sphere: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:29: object.shape: has 2 kinds, must have one: box, cylinder, sphere, ellipsoid or mesh"},
    {"a mesh",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {mesh: cup.stl}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:36: object.shape.mesh: cup.stl does not exist"},
    {"a mesh of no kind",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {mesh: 3}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:36: object.shape.mesh: is 3, must be a mapping (keys: file, scale)"},
    {"a mesh of no size",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {mesh: {file: cup.stl, scale: 0}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:59: object.shape.mesh.scale: is 0, must be above 0"},
    {"a mesh without file",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {mesh: {scale: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:36: object.shape.mesh.file: is missing, must be a file"},
    {"a mesh that is a folder",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {mesh: .}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:36: object.shape.mesh: . is a folder, must be a file"},
    {"a mesh without end",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {mesh: /dev/zero}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:36: object.shape.mesh: /dev/zero is not a regular file"},
    {"a mesh in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, shape: {mesh: cup.stl}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:30: object.shape.mesh: belongs to space (dimension 3), not to the plane"},
    {"density in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {density: 10, shape: {disk: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0], normal: [-1, 0], friction: 1}\n",
     "3:10: object.density: belongs to space (dimension 3), not to the plane"},
    {"density and mass",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {mass: 1, density: 10, shape: {sphere: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], friction: 1}\n",
     "3:28: object.density: is given as well as mass, must be one of them"},
    {"density of nothing",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {density: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:19: object.density: needs a volume, but there is no shape: give weight or mass"},
    {"no density",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {density: 0, shape: {sphere: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], friction: 1}\n",
     "3:19: object.density: is 0, must be above 0"},
    {"adhesion of nothing",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1, adhesion: 0}\n",
     "5:70: contacts[0].adhesion: is 0, must be above 0"},
    {"cups that are too far out",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: suction, position: [0, 0, 3], cups: [[2, 0, 0]], diameter: 1, adhesion: 1, "
     "friction: 1}\n",
     "4:10: gripper: cup 0 meets nothing: it passes the object; the object is 2 x 2 x 2 m large, "
     "its middle at (0, 0, 0) m"},
    {"suction without cups",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: suction, cups: [], diameter: 1, adhesion: 1, friction: 1}\n",
     "4:32: gripper.cups: is empty, must hold at least one cup"},
    {"suction without adhesion",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 1, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: suction, cups: [[0, 0, 3]], diameter: 1, friction: 1}\n",
     "4:10: gripper.adhesion: is missing, must be the pull of a cup [N]"},
    {"a robot that is not there",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {inertial: {urdf: robot.urdf, link: cup}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:27: object.inertial.urdf: robot.urdf does not exist"},
    {"a robot without link",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {inertial: {urdf: robot.urdf}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:20: object.inertial.link: is missing, must be the name of a link"},
    {"inertial and com",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {inertial: {urdf: robot.urdf, link: cup}, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:56: object.com: is given as well as inertial, must be one of them"},
    {"gripper in the plane",
     "poise: 1\n"
     "dimension: 2\n"
     "object: {weight: 10, com: [0, 0]}\n"
     "gripper: {type: parallel_jaw}\n",
     "4:1: gripper: belongs to space (dimension 3), not to the plane"},
    {"gripper beside contacts",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], friction: 1}\n",
     "6:3: contacts: are given as well as a gripper, must be one of them"},
    {"gripper without shape",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "gripper: {type: parallel_jaw}\n",
     "4:10: gripper: needs a shape to close on: give object.shape"},
    {"gripper of no type",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: magnet}\n",
     "4:17: gripper.type: is \"magnet\", must be parallel_jaw, fingertips or suction"},
    {"gripper nowhere",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1}\n",
     "4:10: gripper.position: is missing, must be [x, y, z]"},
    {"gripper without friction",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, position: [0, 0, 0]}\n",
     "4:10: gripper.friction: is missing, must be a number"},
    {"gripper with an unknown key",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 0, 0], openning: 3}\n",
     "4:65: gripper.openning: is not a known key, the nearest is opening"},
    {"gripper that cannot open",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 0, 0], opening: 0}\n",
     "4:74: gripper.opening: is 0, must be above 0"},
    {"gripper without pad",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 0, 0], opening: 3}\n",
     "4:10: gripper.pad: is missing, must be a mapping (keys: width, height, depth)"},
    {"pad of negative depth",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 0, 0], opening: 3,\n"
     "  pad: {width: 1, height: 1, depth: -1}}\n",
     "5:37: gripper.pad.depth: is -1, must be at least 0"},
    {"half a sample",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 0, 0], opening: 3,\n"
     "  pad: {width: 1, height: 1}, samples: 2.5}\n",
     "5:40: gripper.samples: is 2.5, must be a whole number from 1 to 10000"},
    {"rotation of three numbers",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, quaternion: [0, 0, 1]}\n",
     "4:56: gripper.quaternion: is a list of 3, must be [w, x, y, z]"},
    {"rotation without length",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, quaternion: [0, 0, 0, 0]}\n",
     "4:56: gripper.quaternion: has no length, must be a rotation [w, x, y, z]"},
    {"torsion of a smooth gripper",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: fingertips, friction: 0, torsion: 1}\n",
     "4:51: gripper.torsion: is given without friction, must be left out, or give friction above "
     "0"},
    {"torsion of a pad's gripper",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, torsion: 1}\n",
     "4:53: gripper.torsion: is given for pads, must be left out: their points resist the twist"},
    {"a contact of no kind",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, contact: points}\n",
     "4:53: gripper.contact: is \"points\", must be pads or facets"},
    {"fingertips of pads",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: fingertips, friction: 1, contact: pads}\n",
     "4:42: gripper.contact: is not a known key, the nearest is type"},
    {"a jaw without force",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, max_force: 0}\n",
     "4:55: gripper.max_force: is 0, must be above 0"},
    {"a jaw's force and a list of drives",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, max_force: 9}\n"
     "drives: [{moves: [left], along: [1, 0, 0]}]\n",
     "4:55: gripper.max_force: is given as well as a list of drives, must be max of a drive"},
    {"jaws that miss",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 3, 0], opening: 3,\n"
     "  pad: {width: 1, height: 1}}\n",
     "4:10: gripper: the pads meet nothing: the object is not between them; the object is 2 x 2 x "
     "2 "
     "m large, its middle at (0, 0, 0) m"},
    {"jaws inside",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [0, 0, 0], opening: 1,\n"
     "  pad: {width: 0.1, height: 0.1}}\n",
     "4:10: gripper: both pads begin inside the object: open wider, or move the gripper; the "
     "object is 2 x 2 x 2 "
     "m large, its middle at (0, 0, 0) m"},
    {"one jaw inside",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: parallel_jaw, friction: 1, position: [1, 0, 0], opening: 1,\n"
     "  pad: {width: 0.1, height: 0.1}}\n",
     "4:10: gripper: the left pad begins inside the object: open wider, or move the gripper; the "
     "object is 2 x 2 x 2 "
     "m large, its middle at (0, 0, 0) m"},
    {"no rays",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: fingertips, friction: 1, rays: []}\n",
     "4:48: gripper.rays: is empty, must hold at least one ray"},
    {"ray without direction",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: fingertips, friction: 1, rays: [{origin: [0, 0, 2], direction: [0, 0, "
     "0]}]}\n",
     "4:80: gripper.rays[0].direction: has no length, must be a direction"},
    {"ray that misses",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: fingertips, friction: 1, rays: [{origin: [0, 0, 2], direction: [0, 0, "
     "1]}]}\n",
     "4:10: gripper: finger 0 meets nothing: its ray passes the object; the object is 2 x 2 x 2 "
     "m large, its middle at (0, 0, 0) m"},
    {"ray from inside",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "gripper: {type: fingertips, friction: 1,\n"
     "  rays: [{origin: [0, 0, 0], direction: [0, 0, 1], finger: thumb}]}\n",
     "4:10: gripper: finger thumb begins inside the object: begin farther out; the object is 2 x 2 "
     "x 2 "
     "m large, its middle at (0, 0, 0) m"},
    {"box of two sizes",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {box: {size: [1, 2]}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:42: object.shape.box.size: is a list of 2, must be [x, y, z]"},
    {"box without a side",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {box: {size: [1, 2, 0]}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:49: object.shape.box.size[2]: is 0, must be above 0"},
    {"cylinder without height",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {cylinder: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:40: object.shape.cylinder.height: is missing, must be a length"},
    {"needle in space",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {cylinder: {radius: 1e-5, height: 1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:40: object.shape.cylinder: has a height of 50000 diameters, must be from 0.0002 to 5000"},
    {"sphere of negative radius",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: -1}}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:47: object.shape.sphere.radius: is -1, must be above 0"},
    {"ellipsoid of a number",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {ellipsoid: 1}}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n",
     "3:41: object.shape.ellipsoid: is 1, must be a mapping (keys: radii)"},
    {"contact on an edge",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {box: {size: [2, 2, 2]}}}\n"
     "contacts:\n"
     "  - {position: [1, 1, 0], friction: 1}\n",
     "5:16: contacts[0].position: is on the edge between face +x and face +y of the box, give the "
     "normal"},
    {"contact at a corner of a box",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {box: {size: [2, 2, 2]}}}\n"
     "contacts:\n"
     "  - {position: [1, 1, -1], friction: 1}\n",
     "5:16: contacts[0].position: is at the corner between face +x, face +y and face -z of the "
     "box, give the normal"},
    {"contact on the rim",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {cylinder: {radius: 1, height: 2}}}\n"
     "contacts:\n"
     "  - {position: [0, 1, 1], friction: 1}\n",
     "5:16: contacts[0].position: is on the edge between the side and the end +z of the cylinder, "
     "give the normal"},
    {"contact off the solid",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, shape: {sphere: {radius: 1}}}\n"
     "contacts:\n"
     "  - {position: [0, 1.1, 0], friction: 1}\n",
     "5:16: contacts[0].position: is 0.1 m from the boundary of the shape, must be within 0.0001 m "
     "of it, or give the normal"},
    {"position of two numbers",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0], normal: [1, 0, 0], friction: 1}\n",
     "6:16: contacts[1].position: is a list of 2, must be [x, y, z]"},
    {"normal of two numbers",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0], friction: 1}\n",
     "6:35: contacts[1].normal: is a list of 2, must be [x, y, z]"},
    {"normal without length in space",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [0, 0, 0], friction: 1}\n",
     "6:35: contacts[1].normal: has no length, must point from the finger inwards"},
    {"no normal, no solid",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], friction: 1}\n",
     "6:5: contacts[1].normal: is missing, must be [x, y, z], as there is no shape"},
    {"negative torsion",
     "poise: 1\n"
     "dimension: 3\n"
     "length_unit: mm\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0, 0], friction: 1, torsion: -2}\n",
     "7:68: contacts[1].torsion: is -2, must be at least 0"},
    {"torsion without friction",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0, 0], friction: 0, torsion: 0.01}\n",
     "6:68: contacts[1].torsion: is given for a frictionless contact, must be left out, or give "
     "friction above 0"},
    {"a contact too soft to reckon with",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0, 0], friction: 1, torsion: 1e153}\n",
     "6:68: contacts[1].torsion: is 1e+153, must be at most 1e12 times friction times the size "
     "of the grasp"},
    {"torsion is text",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0, 0], friction: 1, torsion: soft}\n",
     "6:68: contacts[1].torsion: is \"soft\", must be a number"},
    {"misspelt torsion",
     "poise: 1\n"
     "dimension: 3\n"
     "object: {weight: 10, com: [0, 0, 0]}\n"
     "contacts:\n"
     "  - {position: [1, 0, 0], normal: [-1, 0, 0], friction: 1}\n"
     "  - {position: [1, 0, 0], normal: [1, 0, 0], friction: 1, torison: 0.01}\n",
     "6:59: contacts[1].torison: is not a known key, the nearest is torsion"},
};

}  // namespace poise
