"""Mutation sites: changes to a source that still compile but alter its meaning."""
from dataclasses import dataclass
from pathlib import Path

from clang.cindex import CursorKind as Kind
from clang.cindex import Index, TypeKind

COMPARISONS = {"<": ["<=", ">"], "<=": ["<", ">="], ">": [">=", "<"], ">=": [">", "<="], "==": ["!="], "!=": ["=="]}
LOGIC = {"&&": ["||"], "||": ["&&"]}
ARITHMETIC = {"+": ["-"], "-": ["+"], "*": ["+"], "%": ["+"]}
NUMBERS = set(range(TypeKind.CHAR_U.value, TypeKind.LONGDOUBLE.value + 1))
# Syntax nodes that are evaluated at compile time. A mutant in them could not be switched on.
CONSTANT = {Kind.STATIC_ASSERT, Kind.CASE_STMT, Kind.ENUM_CONSTANT_DECL, Kind.TEMPLATE_TYPE_PARAMETER,
            Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.FIELD_DECL, Kind.PARM_DECL}


@dataclass(frozen=True)
class Site:
    """Replaces the bytes start..end of a file by `new` while mutant `number` is active."""
    file: str
    line: int
    start: int
    end: int
    kind: str
    old: str
    new: str

    def write(self, number):
        """The replacement text in the mutated source."""
        if self.kind == "statement":
            return f"if (!is_mutant({number})) {{ {self.old}; }}"
        if self.kind == "condition":
            return f"(is_mutant({number}) != static_cast<bool>({self.old}))"
        return f"(is_mutant({number}) ? ({self.new}) : ({self.old}))"


def is_number(cursor):
    return cursor.type.get_canonical().kind.value in NUMBERS


class Finder:
    def __init__(self, root, file):
        self.path, self.file = root / file, file
        self.text = self.path.read_bytes()
        self.sites = []

    def find(self, arguments):
        unit = Index.create().parse(str(self.path), args=arguments)
        for child in unit.cursor.get_children():
            if child.location.file and Path(child.location.file.name).resolve() == self.path.resolve():
                self.visit(child, None)
        return self.sites

    def span(self, cursor):
        extent = cursor.extent
        for end in (extent.start, extent.end):
            if not end.file or Path(end.file.name).resolve() != self.path.resolve():
                return None
        return extent.start.offset, extent.end.offset

    def get(self, start, end):
        return self.text[start:end].decode()

    def add(self, cursor, kind, news):
        span = self.span(cursor)
        if not span or span[0] >= span[1]:
            return
        old = self.get(*span)
        if any(mark in old for mark in ("#", "//", "co_", "return")) and kind != "statement":
            return
        for new in news:
            self.sites.append(Site(self.file, cursor.extent.start.line, *span, kind, old, new))

    def visit(self, cursor, parent):
        kind = cursor.kind
        if kind in CONSTANT:
            return
        if kind == Kind.VAR_DECL and any(t.spelling in ("constexpr", "constinit") for t in list(cursor.get_tokens())[:3]):
            return
        children = list(cursor.get_children())
        if kind == Kind.BINARY_OPERATOR and len(children) == 2:
            self.binary(cursor, *children)
        elif kind == Kind.INTEGER_LITERAL and parent is not None and is_number(cursor):
            span = self.span(cursor)
            if span and self.get(*span).isdigit():
                self.add(cursor, "literal", [self.get(*span) + " + 1"])
        elif kind == Kind.CONDITIONAL_OPERATOR and len(children) == 3:
            self.condition(children[0])
        elif kind == Kind.IF_STMT and children and children[0].kind.is_expression():
            self.condition(children[0])
        elif kind == Kind.CALL_EXPR and cursor.spelling in ("min", "max") and self.span(cursor):
            old = self.get(*self.span(cursor))
            other = {"min": "max", "max": "min"}[cursor.spelling]
            if old.startswith(f"std::{cursor.spelling}("):
                self.add(cursor, "min and max", [f"std::{other}(" + old[9:]])
        if kind == Kind.COMPOUND_STMT:
            for child in children:
                self.statement(child)
        for child in children:
            self.visit(child, cursor)

    def binary(self, cursor, left, right):
        spans = self.span(cursor), self.span(left), self.span(right)
        if not all(spans):
            return
        (start, end), (_, between), (to, _) = spans
        operator = self.get(between, to).strip()
        a, b = self.get(start, between), self.get(to, end)
        if operator in COMPARISONS and is_number(left) and is_number(right):
            self.add(cursor, "comparison", [f"{a} {other} {b}" for other in COMPARISONS[operator]])
        elif operator in LOGIC:
            self.add(cursor, "logic", [f"({a}) {LOGIC[operator][0]} ({b})"])
        elif operator in ARITHMETIC and is_number(left) and is_number(right):
            self.add(cursor, "arithmetic", [f"({a}) {ARITHMETIC[operator][0]} ({b})"])
            if operator in "+-":
                self.add(cursor, "term", [f"+({a})"])

    def condition(self, cursor):
        span = self.span(cursor)
        if span:
            self.add(cursor, "condition", [f"!({self.get(*span)})"])

    def statement(self, cursor):
        """Removes a call or a compound assignment that stands alone."""
        if cursor.kind in (Kind.CALL_EXPR, Kind.COMPOUND_ASSIGNMENT_OPERATOR) and cursor.spelling != "reserve":
            span = self.span(cursor)
            if span and self.text[span[1]:span[1] + 1] == b";":
                self.add(cursor, "statement", [""])


def find_sites(root, file, arguments):
    return Finder(root, file).find(arguments)
