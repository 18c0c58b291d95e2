"""Gathers the pages of the site: docs/, the examples, and the reference made from the sources.

pages.py FOLDER PLAYGROUND, with the installed Python module on the path.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
from pathlib import Path
from typing import Dict, List

import hypertext
import reference
from hypertext import ROOT

LANGUAGES = {".hpp": "cpp", ".cpp": "cpp", ".py": "python", ".yaml": "yaml", ".sh": "sh"}
EXAMPLES = ROOT / "examples"


class Site:
    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.shown: Dict[Path, str] = {}  # sources that pages link to, and where they are shown

    def place(self, file: Path) -> str:
        """Where the site has a file of the repository."""
        name = file.relative_to(ROOT)
        if name.parts[0] == "docs":
            return str(name.relative_to("docs"))
        if name.parts[:2] == ("include", "poise"):
            return f"reference/cpp/{file.stem}.md"
        if file.is_dir():
            if EXAMPLES not in [file, *file.parents]:
                raise SystemExit(f"{name}: the site has no page of this folder")
            return "examples.md"
        if file == ROOT / "README.md":
            return "index.md"
        if file.suffix == ".md":
            return f"{file.stem.lower()}.md"
        return self.shown.setdefault(file, f"sources/{name}.md")

    def write(self, place: str, text: str) -> None:
        file = self.folder / place
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def page(self, file: Path) -> None:
        """A page that people also read in the repository."""
        here = self.place(file)

        def target(link: str) -> str:
            path, hash_, anchor = link.partition("#")
            if not path:
                return link
            there = self.place((file.parent / path).resolve())
            return os.path.relpath(there, os.path.dirname(here) or ".") + hash_ + anchor

        text = hypertext.relinked(file.read_text(encoding="utf-8"), target)
        text = text.replace("```console\n", "```text\n")  # coloured it is hard to read
        # Where the repository has a picture of it, the site has the page itself.
        text, played = re.subn(
            r"<!-- playground -->\n!\[([^\]]*)\]\([^)]*\)",
            r'<iframe class="playground" src="./app/playground.html" title="\1" loading="lazy"></iframe>'
            '\n\n<a href="./app/playground.html" target="_self">Open it whole</a>',
            text,
        )
        self.write(here, ("---\npageClass: wide\naside: false\n---\n\n" if played else "") + text)

    def source(self, file: Path) -> str:
        text = file.read_text(encoding="utf-8")
        return f"````{LANGUAGES.get(file.suffix, 'text')}\n{text.rstrip()}\n````\n\n"

    def examples(self) -> None:
        """The numbered programs with what they print, then the grasp files."""
        text = "# Examples\n\nPrograms in C++ and Python, twins of each other, and what they print. "
        text += "Below them are the grasp files that they and these pages use.\n\n"
        for expected in sorted((EXAMPLES / "expected").glob("*.txt")):
            number, name = expected.stem.split("_", 1)
            text += f"## {int(number)}. {name.replace('_', ' ').capitalize()}\n\n::: code-group\n\n"
            for folder, suffix, title in [("python", ".py", "Python"), ("cpp", ".cpp", "C++")]:
                file = EXAMPLES / folder / f"{expected.stem}{suffix}"
                if file.exists():
                    text += self.source(file).replace("````" + LANGUAGES[suffix], f"````{LANGUAGES[suffix]} [{title}]", 1)
            text += ":::\n\n" + self.source(expected)
        text += "## Grasp files\n\n"
        for file in sorted(EXAMPLES.glob("*.yaml")):
            text += f"### {file.name}\n\n{self.source(file)}"
        self.write("examples.md", text)


def main(folder: Path, playground: Path) -> None:
    site = Site(folder)
    shutil.rmtree(folder, ignore_errors=True)
    for page in hypertext.pages():
        if page != ROOT / "README.md":
            site.page(page)
    shutil.copytree(ROOT / "docs/pictures", folder / "pictures", ignore=shutil.ignore_patterns("*.py", "*.sh"))
    (folder / "node_modules").symlink_to(ROOT / "site/node_modules")  # where pages look for Vue
    (folder / "public/app").mkdir(parents=True)
    shutil.copy(playground, folder / "public/app/playground.html")
    site.examples()
    for file, place in site.shown.items():
        site.write(place, f"# {file.relative_to(ROOT)}\n\n{site.source(file)}")
    order: List[str] = []
    for name, text in reference.cpp_pages().items():
        site.write(f"reference/cpp/{name}.md", text)
        order.append(name)
    site.write("reference/python.md", reference.Python().page())
    site.write("headers.json", json.dumps([name for name in order if name != "index"]))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
