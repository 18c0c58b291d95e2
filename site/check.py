"""Whether what was built holds together: check.py FOLDER.

Every link leads to a page, a picture or an anchor that is there, every page can be reached from the
first one, and nothing is asked of another host.
"""

from __future__ import annotations

import posixpath
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Dict, List, Set, Tuple
from urllib.parse import unquote

LOADED = {"img": "src", "script": "src", "iframe": "src", "link": "href", "source": "src"}


class Page(HTMLParser):
    def __init__(self, file: Path) -> None:
        super().__init__()
        self.anchors: Set[str] = set()
        self.links: List[Tuple[str, str]] = []  # tag and target
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: List[Tuple[str, "str | None"]]) -> None:
        given = dict(attributes)
        if given.get("id"):
            self.anchors.add(str(given["id"]))
        for name in {"a": ["href"]}.get(tag, [LOADED[tag]] if tag in LOADED else []):
            if given.get(name):
                self.links.append((tag, str(given[name])))


def main(folder: Path, base: str) -> List[str]:
    pages: Dict[str, Page] = {
        str(file.relative_to(folder)): Page(file)
        for file in folder.rglob("*.html")
        if "app" not in file.relative_to(folder).parts
    }
    problems = []
    reached: Dict[str, Set[str]] = {}
    for name, page in pages.items():
        reached[name] = set()
        for tag, target in page.links:
            if target.startswith("data:"):
                continue
            if re.match(r"[a-z]+:|//", target):
                if tag != "a":
                    problems.append(f"{name}: loads {target} from another host")
                continue
            path, _, anchor = target.partition("#")
            path = unquote(path)
            if path.startswith(base):
                there = path[len(base) :]
            elif path.startswith("/"):
                problems.append(f"{name}: {target} is outside of {base}")
                continue
            else:
                there = posixpath.normpath(posixpath.join(posixpath.dirname(name), path)) if path else name
            there = posixpath.join(there, "index.html") if there in ("", ".") or there.endswith("/") else there
            if not (folder / there).is_file():
                problems.append(f"{name}: there is no {target}")
            elif anchor and there in pages and unquote(anchor) not in pages[there].anchors:
                problems.append(f"{name}: there is no {target}")
            reached[name].add(there)
    for style in folder.rglob("*.css"):
        for target in re.findall(r"url\(['\"]?(?!data:)([^)'\"]*)", style.read_text(encoding="utf-8")):
            if re.match(r"[a-z]+:|//", target):
                problems.append(f"{style.relative_to(folder)}: loads {target} from another host")
    waiting, seen = ["index.html"], {"index.html"}
    while waiting:
        for there in reached.get(waiting.pop(), set()) - seen:
            seen.add(there)
            waiting.append(there)
    problems += [f"{name}: no way leads here" for name in pages if name not in {*seen, "404.html"}]
    if not pages:
        problems.append(f"{folder} has no pages")
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links")
    return sorted(set(problems))


if __name__ == "__main__":
    found = main(Path(sys.argv[1]), sys.argv[2])
    sys.exit("\n".join(found) or 0)
