"""Pages in Markdown: their headings, listings and links."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Dict, Iterator, List

ROOT = Path(__file__).resolve().parents[1]


@dataclass
class Listing:
    page: Path
    line: int
    language: str
    text: str

    @property
    def place(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"


@dataclass
class Link:
    line: int
    target: str  # as written
    start: int
    end: int


def pages() -> List[Path]:
    """Those that people read: here, and on the site."""
    return sorted(ROOT.glob("*.md")) + sorted((ROOT / "docs").glob("**/*.md"))


FENCE = re.compile(r"^( *)(`{3,}|~{3,})([^\n]*)\n(.*?)^\1\2 *$", re.DOTALL | re.MULTILINE)


def listings(page: Path) -> List[Listing]:
    """What stands between fences."""
    text = page.read_text(encoding="utf-8")
    found = []
    for fence in FENCE.finditer(text):
        body = re.sub(rf"^{fence[1]}", "", fence[4], flags=re.MULTILINE)
        found.append(Listing(page, text[: fence.start()].count("\n") + 1, fence[3], body))
    if len(re.findall(r"^ *(?:```|~~~)", text, re.MULTILINE)) != 2 * len(found):
        raise ValueError(f"{page}: a listing does not end")
    return found


def prose(text: str) -> str:
    """The text with everything that is not prose blanked out, so that places stay."""

    def blank(found: "re.Match[str]") -> str:
        return re.sub(r"[^\n]", " ", found[0])

    text = FENCE.sub(blank, text)
    text = re.sub(r"(`+)(?!`).+?(?<!`)\1(?!`)", blank, text, flags=re.DOTALL)
    return re.sub(r"\$\$.*?\$\$|\$[^$\n]*\$", blank, text, flags=re.DOTALL)


def slug(heading: str) -> str:
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def anchors(text: str) -> List[str]:
    found: Dict[str, int] = {}
    result = []
    for heading in re.findall(r"^#+ +(.+)$", FENCE.sub("", text), re.MULTILINE):
        name = slug(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.replace("`", "")))
        result.append(f"{name}-{found[name]}" if name in found else name)
        found[name] = found.get(name, 0) + 1
    return result


def links(text: str) -> Iterator[Link]:
    """All of them, pictures too."""
    for found in re.finditer(r"\]\(\s*([^()\s]+)[^()]*\)|\b(?:src|href)=\"([^\"]*)\"", prose(text)):
        group = 1 if found[1] else 2
        yield Link(text[: found.start()].count("\n") + 1, found[group], *found.span(group))


def external(target: str) -> bool:
    return bool(re.match(r"[a-z]+:", target))


def relinked(text: str, new: Callable[[str], str]) -> str:
    """The page with other targets."""
    for link in reversed(list(links(text))):
        if not external(link.target):
            text = text[: link.start] + new(link.target) + text[link.end :]
    return text


def dead_links(page: Path) -> List[str]:
    """Links to what is not there."""
    text = page.read_text(encoding="utf-8")
    name = page.relative_to(ROOT)
    dead = [
        f"{name}:{text[: found.start()].count(chr(10)) + 1}: write the link where it is used"
        for found in re.finditer(r"^ *\[[^\]]+\]: ", prose(text), re.MULTILINE)
    ]
    for link in links(text):
        if external(link.target):
            continue
        path, _, anchor = link.target.partition("#")
        there = (page.parent / path).resolve() if path else page
        if not there.exists() or ROOT not in [there, *there.parents]:
            dead.append(f"{name}:{link.line}: there is no {path}")
        elif anchor and (
            there.suffix != ".md" or anchor not in anchors(there.read_text(encoding="utf-8"))
        ):
            dead.append(f"{name}:{link.line}: {path} has no #{anchor}")
    return dead
