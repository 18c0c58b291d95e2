"""What Poise raises."""


class PoiseError(Exception):
    """The base of all exceptions of Poise."""


class InvalidGrasp(PoiseError, ValueError):
    """A grasp that has no meaning: which field is wrong, and what would be right."""

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(path, problem)
        self.path = path  #: "contacts[1].friction"
        self.problem = problem  #: "is -1, must be at least 0"

    def __str__(self) -> str:
        return f"{self.path}: {self.problem}"


class FileError(PoiseError, ValueError):
    """A grasp file, or dictionary, that cannot be used: what is wrong with it, and where."""

    def __init__(self, file: str, line: int, column: int, path: str, problem: str) -> None:
        super().__init__(file, line, column, path, problem)
        self.file = file  #: its name; "" for a dictionary
        self.line = line  #: from 1; 0: the file as a whole, or a dictionary
        self.column = column  #: from 1; 0: the file as a whole, or a dictionary
        self.path = path  #: "contacts[1].friction", or ""
        self.problem = problem  #: "is -1, must be at least 0"

    def __str__(self) -> str:
        place = f"{self.file}:" if self.file else ""
        place += f"{self.line}:{self.column}:" if self.line else ""
        return " ".join(filter(None, [place, self.path and f"{self.path}:", self.problem]))
