"""The public headers, read: every declaration with its comment.

A header is cut into declarations without loss: what is neither a declaration, a comment nor blank
is an error, so nothing can be left out silently.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import List, Tuple


class Unread(Exception):
    """A header that cannot be read, or a declaration that lacks its comment."""


@dataclass
class Declaration:
    kind: str  # "type", "function", "value", "enumerator"
    name: str
    code: str  # as written, without the body
    comment: str = ""  # its lines, joined
    line: int = 0
    of_language: bool = False  # copies, moves and destroys: needs no words
    members: List["Declaration"] = field(default_factory=list)  # the public ones


@dataclass
class Header:
    name: str  # "hold"
    about: str  # what stands above #pragma once
    declarations: List[Declaration]


CLOSES = {"(": ")", "{": "}", "[": "]"}


def _skip(text: str, at: int) -> int:
    """Behind the string, character or comment that begins here, or `at` where none does."""
    if text.startswith("//", at):
        end = text.find("\n", at)
        return len(text) if end < 0 else end
    if text[at] in "\"'":
        found = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'').match(text, at)
        if not found:
            raise Unread(f"a string does not end: {text[at:at + 40]!r}")
        return found.end()
    return at


def _closing(text: str, at: int) -> int:
    """The place of the bracket that closes the one here."""
    waiting: List[str] = []
    while at < len(text):
        behind = _skip(text, at)
        if behind != at:
            at = behind
            continue
        if text[at] in CLOSES:
            waiting.append(CLOSES[text[at]])
        elif waiting and text[at] == waiting[-1]:
            waiting.pop()
            if not waiting:
                return at
        at += 1
    raise Unread("a bracket is not closed")


def _words(lines: List[str]) -> str:
    return "\n".join(lines).strip()


def _plain(code: str) -> str:
    """Without comments, attributes and what a template takes."""
    code = re.sub(r"//[^\n]*", "", code)
    return re.sub(r"\s+", " ", re.sub(r"^\s*template\s*<[^>]*>\s*", "", code)).strip()


def _head(text: str, at: int) -> Tuple[int, str]:
    """Where a declaration that begins here has its first brace or its end, and which of them."""
    while at < len(text):
        behind = _skip(text, at)
        if behind != at:
            at = behind
        elif text[at] in "([":
            at = _closing(text, at) + 1
        elif text[at] in ";{":
            return at, text[at]
        else:
            at += 1
    raise Unread("a declaration does not end")


def _without_initialisers(code: str) -> str:
    """A constructor without what follows its single colon."""
    depth = 0
    for found in re.finditer(r"[()]|(?<!:):(?!:)", code):
        depth += {"(": 1, ")": -1}.get(found[0], 0)
        if found[0] == ":" and depth == 0:
            return code[: found.start()].rstrip()
    return code


def _names(code: str) -> str:
    """Of the variables that a declaration declares: "from, to"."""
    bare = _plain(code)
    while (shorter := re.sub(r"<[^<>]*>|\{[^{}]*\}|\([^()]*\)", "", bare)) != bare:
        bare = shorter
    return ", ".join(part.split("=")[0].split()[-1] for part in bare.split(","))


def _enumerators(body: str, line: int) -> List[Declaration]:
    found = []
    for each in re.finditer(r"\s*(\w+)\s*,?[ ]*((?:///<[^\n]*\n?\s*)*)", body):
        words = _words([part.strip() for part in re.findall(r"///<([^\n]*)", each[2])])
        number = line + body[: each.start(1)].count("\n")
        found.append(Declaration("enumerator", each[1], each[1], words, number))
    return found


def _read(text: str, line: int, public: bool, owner: str) -> List[Declaration]:
    """The public declarations of a namespace or a class."""
    found: List[Declaration] = []
    comment: List[str] = []
    beneath = None  # the declaration on the line above
    at = 0
    while at < len(text):
        number = line + text[:at].count("\n")
        if text[at].isspace():
            if text.startswith("\n\n", at):
                if comment:
                    raise Unread(f"line {number}: a comment without a declaration")
                beneath = None
            at += 1
        elif text.startswith("///", at):
            end = text.index("\n", at)
            comment.append(text[at + 3 : end].strip())
            at = end
        elif text.startswith("//", at):
            at = text.index("\n", at)
        elif access := re.compile(r"(public|private|protected):").match(text, at):
            public = access[1] == "public"
            at = access.end()
        else:
            column = at - text.rfind("\n", 0, at) - 1
            end, mark = _head(text, at)
            head = text[at:end].rstrip()
            plain = _plain(head)
            members: List[Declaration] = []
            kind = "value"
            if named := re.match(r"(struct|class|enum class) (\w+(?:<[^>]*>)?)", plain):
                kind, name = "type", named[2]
                if mark == "{":
                    last = _closing(text, end)
                    inside, first = text[end + 1 : last], number + text[at:end].count("\n")
                    if named[1] == "enum class":
                        members = _enumerators(inside, first)
                    else:
                        members = _read(inside, first, named[1] == "struct", re.sub("<.*", "", name))
                    end = text.index(";", last)
            elif called := re.match(
                r"(?:(?!\boperator\b)[^({=])*?(operator *[^\s\w]+|~?\w+)\(", plain
            ):
                kind, name = "function", called[1]
                if mark == "{":
                    end = _closing(text, end)
                    if text.startswith(";", end + 1):
                        end += 1
                    head = _without_initialisers(head)
            elif plain.startswith("using "):
                name = plain.split()[1]
                head = text[at:end]
            else:
                if mark == "{":
                    end = text.index(";", _closing(text, end))
                    head = text[at:end]
                name = _names(head)
            at = end + 1
            trailing = re.compile(r"[ ]*///<([^\n]*)((?:\n\s*///<[^\n]*)*)").match(text, at)
            if trailing:
                comment += [trailing[1].strip()]
                comment += [each.strip() for each in re.findall(r"///<([^\n]*)", trailing[2])]
                at = trailing.end()
            declaration = Declaration(
                kind, name, head.replace("\n" + " " * column, "\n") + ";", _words(comment), number
            )
            declaration.members = members
            same = owner and re.fullmatch(rf"~?{owner}", name)
            declaration.of_language = bool(
                name == "operator="
                or (same and (name[0] == "~" or re.search(rf"\(\)|\((const )?{owner}&", head)))
            )
            if not declaration.comment and beneath and beneath.name == name:
                declaration.comment = beneath.comment  # an overload, under one comment
            comment = []
            beneath = declaration
            if public and not plain.startswith("static_assert"):
                found.append(declaration)
    return found


def read(file: Path) -> Header:
    """A header of the library."""
    return parse(file.stem, file.read_text(encoding="utf-8"))


def parse(name: str, text: str) -> Header:
    """A header from its text."""
    frame = re.fullmatch(
        r"((?://[^\n]*\n)+)#pragma once\n((?:\n|#include [^\n]*\n)*)"
        r"namespace poise \{\n(.*)\}  // namespace poise\n",
        text,
        re.DOTALL,
    )
    if not frame:
        raise Unread(f"{name}.hpp: is not a comment, #pragma once, includes, namespace poise")
    about = " ".join(line.strip("/ ") for line in frame[1].splitlines())
    line = text[: frame.start(3)].count("\n") + 1
    try:
        declarations = _read(frame[3], line, True, "")
    except Unread as problem:
        raise Unread(f"{name}.hpp: {problem}") from None
    return Header(name, about, declarations)


def silent(header: Header) -> List[str]:
    """What lacks its comment: types, and functions wherever they stand."""
    found = []
    told = {each.name for each in header.declarations if each.comment}

    def look(declarations: List[Declaration], owner: str) -> None:
        for each in declarations:
            wanted = each.kind == "function" and not each.of_language or not owner
            specialised = "<" in each.name and each.name.split("<")[0] in told
            if wanted and not each.comment and not specialised:
                found.append(f"{header.name}.hpp:{each.line}: {owner}{each.name} has no comment")
            if each.kind == "type":
                look(each.members, f"{each.name}::")

    look(header.declarations, "")
    return found
