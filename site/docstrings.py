"""The comments of the headers as a header of its own, for the docstrings of bindings/python: docstrings.py OUT"""

import re
import sys
from pathlib import Path

import headers

HEADERS = Path(__file__).resolve().parents[1] / "include/poise"


def comments():
    """Of each name, "Hold.effort", the first that is said."""
    found = {}
    for file in sorted(HEADERS.glob("*.hpp")):
        for each in headers.read(file).declarations:
            name = re.sub("<.*", "", each.name)
            said = [(name, each.comment)]
            said += [(f"{name}.{part}", m.comment) for m in each.members for part in m.name.split(", ")]
            for key, comment in said:
                if comment and not found.get(key):
                    found[key] = comment.replace("::", ".").replace("`", "")
    return found


if __name__ == "__main__":
    text = "// Made by site/docstrings.py.\n#include <map>\n#include <string>\n\n"
    text += "inline const std::map<std::string, std::string> comments_of_headers{\n"
    text += "".join(f'    {{"{key}", R"says({said})says"}},\n' for key, said in comments().items())
    Path(sys.argv[1]).write_text(text + "};\n", encoding="utf-8")
