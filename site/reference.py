"""The reference of the C++ library, from its headers, and of the Python module, from its stub and docstrings."""

from __future__ import annotations

import ast
import dataclasses
import enum
import html
import importlib
import inspect
import re
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Tuple

import headers
import hypertext
from hypertext import ROOT, slug

HEADERS = ROOT / "include/poise"


def reading_order() -> List[str]:
    """The headers, as CONTRIBUTING.md says to read them."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    (row,) = re.findall(r"^\| `include/poise/` \|([^|]*)\|", text, re.MULTILINE)
    order = re.findall(r"`(\w+)`", row)
    there = sorted(file.stem for file in HEADERS.glob("*.hpp"))
    if sorted(order) != there:
        raise headers.Unread(f"CONTRIBUTING.md names {sorted(order)}, include/poise has {there}")
    return order


def prose(text: str, depth: str) -> str:
    """A comment as it stands, as HTML: words in backticks are code, pages are linked."""
    parts = re.split(r"`([^`\n]*)`", text)
    for k, part in enumerate(parts):
        part = html.escape(part, quote=False).replace("{{", "&#123;&#123;")
        if k % 2:
            parts[k] = f"<code v-pre>{part}</code>"
            continue
        part = re.sub(
            r'docs/([\w-]+)\.md(?:, "([^"]+)")?',
            lambda page: f'<a href="{depth}{page[1]}.html'
            + (f'#{slug(page[2])}">{page[2]}</a>' if page[2] else f'">{page[1]}</a>'),
            part,
        )
        parts[k] = re.sub(r"^@(param|throws) +(\w+) *", r"<em>\1</em> <code>\2</code> ", part, flags=re.MULTILINE)
    return "".join(parts)


def paragraphs(text: str, depth: str) -> str:
    """Each paragraph, parameter and exception by itself; what is set in is a formula."""
    blocks = re.split(r"\n\n|\n(?=@|Raises |[a-z_]+(?:, [a-z_]+)*: )", text)
    return "\n\n".join(f"<p>{prose(block, depth)}</p>" for block in blocks if block) + "\n\n"


def code(language: str, text: str) -> str:
    return f"```{language}\n{text}\n```\n\n"


def inline(text: str) -> str:
    return f"<code v-pre>{html.escape(re.sub(chr(10) + ' *', ' ', text), quote=False)}</code>"


def terms(rows: List[Tuple[str, str]]) -> str:
    """Names and what they mean."""
    if not rows:
        return ""
    body = "".join(f"<dt>{name}</dt><dd>{words}</dd>\n" for name, words in rows)
    return f'<dl class="members">\n{body}</dl>\n\n'


# C++


def cpp_places(header: headers.Header) -> Dict[str, str]:
    """The names that a page has, and their anchors: `Hold` and `hold` are two."""
    names = dict.fromkeys(each.name for each in header.declarations)
    found = hypertext.anchors("".join(f"## {name}\n" for name in names))
    return dict(zip(names, found))


def cpp_page(header: headers.Header) -> str:
    depth = "../../"
    text = f"# poise/{header.name}.hpp\n\n{paragraphs(header.about, depth)}"
    text += code("cpp", f'#include "poise/{header.name}.hpp"')
    shown = None
    for each in header.declarations:
        if each.name != shown:
            text += f"## {html.escape(each.name)}\n\n"
        following = [other for other in header.declarations if other.comment == each.comment]
        if each.comment and each is not following[-1] and each.name == following[-1].name:
            text += code("cpp", each.code)  # an overload, under one comment
        else:
            text += code("cpp", each.code) + paragraphs(each.comment, depth)
        text += terms([(inline(member.code), cpp_words(each, member, depth)) for member in each.members])
        shown = each.name
    return text


def cpp_words(owner: headers.Declaration, member: headers.Declaration, depth: str) -> str:
    alike = [other for other in owner.members if other.comment == member.comment]
    if alike[-1] is not member and alike[-1].name == member.name:
        return ""  # an overload, under one comment
    return prose(member.comment, depth).replace("\n\n", "<br>")


def cpp_pages() -> Dict[str, str]:
    """The page of each header, in reading order."""
    read = [headers.read(HEADERS / f"{name}.hpp") for name in reading_order()]
    silent = [problem for header in read for problem in headers.silent(header)]
    if silent:
        raise headers.Unread("\n".join(silent))
    pages = {header.name: cpp_page(header) for header in read}
    index = "# C++\n\n"
    index += paragraphs(
        "The public headers, in the order in which they are best read. Whatever stands here "
        "is the comment in the header. What cannot be held is a value, not an exception; "
        "exceptions (`poise::InvalidGrasp`) are for input that has no meaning.",
        "../../",
    )
    for header in read:
        index += f"## [poise/{header.name}.hpp]({header.name}.md)\n\n{paragraphs(header.about, '../../')}"
        places = cpp_places(header).items()
        index += " · ".join(f"[`{name}`]({header.name}.md#{anchor})" for name, anchor in places)
        index += "\n\n"
    return {"index": index, **pages}


# Python

WRITTEN = re.compile(r"(?:\d+\. )?(\w+)\((.*)\) -> (.*)")  # as pybind11 writes a signature


def said(docstring: Optional[str]) -> List[str]:
    """The words of a docstring, without the signatures that pybind11 writes into it."""
    lines = inspect.cleandoc(docstring or "").splitlines()
    if lines[1:2] == ["Overloaded function."]:
        parts = re.split(r"^\d+\. .*\n", "\n".join(lines[2:]), flags=re.MULTILINE)[1:]
        return [part.strip() for part in parts]
    if lines and WRITTEN.match(lines[0]):
        lines = lines[1:]
    return ["\n".join(lines).strip()]


def signature(stub: ast.FunctionDef, written: str, name: str) -> str:
    """From the stub, its defaults from what pybind11 has written."""
    arguments = stub.args
    arguments.args = [each for each in arguments.args if each.arg != "self"]

    def default(argument: ast.arg, value: ast.expr) -> ast.expr:
        found = re.search(rf"\b{argument.arg}: [^=]*? = (.*?)(?=, \w+: |, \*|$)", written)
        if not found:
            raise headers.Unread(f"{name}: no default of {argument.arg} in {written!r}")
        return ast.parse(re.sub(r"<(\w+\.\w+): [^>]*>", r"\1", found[1]), mode="eval").body

    offset = len(arguments.args) - len(arguments.defaults)
    for k, value in enumerate(arguments.defaults):
        arguments.defaults[k] = default(arguments.args[offset + k], value)
    for k, value in enumerate(arguments.kw_defaults):
        if value is not None:
            arguments.kw_defaults[k] = default(arguments.kwonlyargs[k], value)
    parts = ast.unparse(arguments)
    result = f" -> {ast.unparse(stub.returns)}" if stub.name != "__init__" else ""
    return f"{name}({parts}){result}"


def tidy(text: str, width: int = 88) -> str:
    """Types and numbers as people write them; long signatures over several lines."""
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", text)  # annotations
    text = re.sub(r"NDArray\[np\.(\w+?)_?\]", r"ndarray[\1]", text)
    text = re.sub(r"\b_core\.|\btyping\.|\bnumpy\.typing\.|\bpoise\.", "", text)
    text = re.sub(r"<(\w+\.\w+): [^>]*>", r"\1", text).replace("<factory>", "[]")
    text = re.sub(r"(?<=[\w\]])=(?=\S)", " = ", text)
    text = re.sub(r"\b1(0+)\.0\b", lambda zeros: f"1e{len(zeros[1])}" if zeros[1] != "0" else zeros[0], text)
    if len(text) <= width:
        return text
    head, rest = text.split("(", 1)
    inside, tail = rest[: rest.rindex(")")], rest[rest.rindex(")") :]
    depth, parts = 0, [""]
    for letter in inside:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return head + "(\n" + "".join(f"    {part.strip()},\n" for part in parts) + tail


class Python:
    """The reference of the installed module."""

    def __init__(self) -> None:
        self.module = importlib.import_module("poise")
        self.core = importlib.import_module("poise._core")
        stub = Path(self.core.__file__).with_name("_core.pyi").read_text(encoding="utf-8")
        self.stub: Dict[str, List[ast.stmt]] = {}
        for node in ast.parse(stub).body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                self.stub.setdefault(node.name, []).append(node)
        self.places: Dict[str, str] = {}
        self.comments: Dict[Tuple[str, str], str] = {}
        for name in reading_order():
            header = headers.read(HEADERS / f"{name}.hpp")
            for each, anchor in cpp_places(header).items():
                self.places.setdefault(re.sub("<.*", "", each), f"cpp/{name}.md#{anchor}")
            for each in header.declarations:
                self.comments.setdefault((re.sub("<.*", "", each.name), ""), each.comment)
                for member in each.members:
                    for part in member.name.split(", "):
                        key = re.sub("<.*", "", each.name), part
                        self.comments.setdefault(key, member.comment)

    def page(self) -> str:
        text = "# Python\n\n" + paragraphs(inspect.getdoc(self.module) or "", "../")
        text += "How to install and use it: [Python](../python.md).\n\n"
        names = [name for name in self.module.__all__]
        groups: Dict[str, List[str]] = {name: [] for name in reading_order()}
        others: List[str] = []
        for name in names:
            place = self.places.get(name)
            (groups[re.findall(r"cpp/(\w+)", place)[0]] if place else others).append(name)
        for header, group in groups.items():
            if group:
                order = list(self.places)
                text += f"## As in [poise/{header}.hpp](cpp/{header}.md)\n\n"
                text += "".join(self.entry(name) for name in sorted(group, key=order.index))
        text += "## Only in Python\n\n"
        text += "".join(self.entry(name) for name in others)
        dask = importlib.import_module("poise.dask")
        text += "## poise.dask\n\n" + paragraphs(inspect.getdoc(dask) or "", "../")
        for name, value in vars(dask).items():
            if getattr(value, "__module__", "") == "poise.dask":
                text += self.plain(f"dask.{name}", value)
        return text

    def twins(self) -> Iterator[Tuple[str, str, str]]:
        """Each name that both languages have: its docstring, and the comment in the header."""
        for name in self.module.__all__:
            value = getattr(self.module, name)
            own = [("", value.__doc__)] if callable(value) else []
            if isinstance(value, type) and issubclass(value, enum.Enum):
                own += [(each.name, self.beside(value, each.name)) for each in value]
            elif name in self.stub and isinstance(value, type):
                public = {each: member for each, member in vars(value).items() if each[0] != "_"}
                own += [(each, member.__doc__) for each, member in public.items()]
            for member, docstring in own:
                comment = self.comments.get((name, member.rstrip("_")), "")
                words = " ".join(said(docstring))
                if comment and words:
                    yield f"{name}.{member}".rstrip("."), words, comment

    def entry(self, name: str) -> str:
        value = getattr(self.module, name)
        if name in self.stub:
            return self.compiled(name, self.stub[name])
        if not callable(value):
            return f"### {name}\n\n" + code("python", f"{name} = {value!r}") + self.see(name)
        return self.plain(name, value)

    def see(self, name: str) -> str:
        return f"In C++: [`{name}`]({self.places[name]}).\n\n" if name in self.places else ""

    def words(self, name: str, text: str) -> str:
        if not text:
            raise headers.Unread(f"poise.{name} has no docstring")
        return paragraphs(text, "../")

    def compiled(self, name: str, stubs: List[ast.stmt]) -> str:
        """What stands in the stub."""
        value = getattr(self.core, name)
        text = f"### {name}\n\n"
        if isinstance(stubs[0], ast.FunctionDef):
            written = re.findall(WRITTEN, value.__doc__)
            written = [each for each in written if "*args" not in each[1]]
            for stub, (_, arguments, _), words in zip(stubs, written, said(value.__doc__)):
                text += code("python", tidy(signature(stub, arguments, name)))
                text += self.words(name, words)
            return text + self.see(name)
        (stub,) = stubs
        rows = []
        for each in stub.body:
            member = getattr(value, each.name)
            (words,) = said(member.__doc__)
            if each.decorator_list:
                shown = tidy(f"{each.name}: {ast.unparse(each.returns)}")
            else:
                written = WRITTEN.match((member.__doc__ or "").splitlines()[0])
                arguments = written[2] if written and "*args" not in written[2] else ""
                if each.name == "__init__":
                    text += code("python", tidy(signature(each, arguments, name)))
                    continue
                if each.name in ("__len__", "__iter__", "__getitem__"):
                    continue  # what a sequence has
                shown = tidy(signature(each, arguments, each.name), 1000)
            plain = each.name.rstrip("_").replace("__call", "operator()").strip("_")
            words = words or self.comments.get((name, plain), "")
            rows.append((inline(shown), prose(words, "../").replace("\n\n", "<br>")))
        if all(each.name != "__init__" for each in stub.body):
            bases = ", ".join(ast.unparse(base) for base in stub.bases)
            text += code("python", f"class {name}({bases})" if bases else f"class {name}")
        return text + self.words(name, said(value.__doc__)[0]) + terms(rows) + self.see(name)

    def plain(self, name: str, value: object) -> str:
        """What is written in Python."""
        text = f"### {name}\n\n"
        rows = []
        doc = inspect.getdoc(value) or ""
        if inspect.isclass(value) and issubclass(value, enum.Enum):
            text += code("python", f"class {name}(enum.Enum)")
            rows = [(inline(each.name), prose(self.beside(value, each.name), "../")) for each in value]
        elif inspect.isclass(value):
            if issubclass(value, Exception):
                bases = ", ".join(base.__name__ for base in value.__bases__)
                text += code("python", f"class {name}({bases})")
            else:
                shown = f"{name}{inspect.signature(value)}".replace(" -> 'None'", "")
                text += code("python", tidy(shown.replace(" -> None", "")))
            if dataclasses.is_dataclass(value):
                for each in dataclasses.fields(value):
                    rows.append((inline(tidy(f"{each.name}: {each.type}")), prose(self.beside(value, each.name), "../")))
                if doc.startswith(f"{value.__name__}("):
                    doc = ""
            elif issubclass(value, Exception):
                found = re.findall(r"self\.(\w+) = \w+  #: (.*)", inspect.getsource(value))
                rows = [(inline(each), prose(words, "../")) for each, words in found]
            for each, member in vars(value).items():
                if not each.startswith("_") and inspect.isfunction(member):
                    shown = re.sub(r"\(self(, )?", "(", tidy(f"{each}{inspect.signature(member)}", 1000))
                    rows.append((inline(shown), prose(inspect.getdoc(member) or "", "../")))
        else:
            text += code("python", tidy(f"{name}{inspect.signature(value)}"))
            for each, member in vars(type(value)).items():  # of what is called, and has functions
                if not each.startswith("_") and inspect.isfunction(member):
                    shown = tidy(f"{name}.{each}{inspect.signature(getattr(value, each))}", 1000)
                    words = prose(inspect.getdoc(member) or "", "../").replace("\n\n", "<br>")
                    rows.append((inline(shown), words))
        return text + self.words(name, doc) + terms(rows) + self.see(name)

    def beside(self, owner: type, name: str) -> str:
        """What is said about an attribute, above it or beside it, after `#:`."""
        source = inspect.getsource(owner)
        above = re.search(rf"((?:^ *#: .*\n)+) *{name}\b *[:=]", source, re.MULTILINE)
        beside = re.search(rf"^ *{name}\b *[:=].*?  #: (.*)", source, re.MULTILINE)
        if above:
            return " ".join(line.strip("#: ") for line in above[1].strip().splitlines())
        return beside[1] if beside else ""
