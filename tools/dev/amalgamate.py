#!/usr/bin/env python3
"""Writes the whole library as two files, pel.c and pel.h.

    amalgamate.py OUT_DIR [--root PROJECT_DIR]

The sources come from lib/pel_files.cmake, the headers from the #include lines. Names that a source
file has for itself (static functions, constants, types, and those of private headers) are prefixed
with the name of their file wherever another file uses the same word, so that nothing clashes and
nothing shadows. A header called ..._template.h is read by several files, each of which says what
its words mean: it becomes a part of each. What this cannot solve ends the run with an error, and no
file is written.
"""
import argparse
import collections
import pathlib
import re
import sys

import project
from project import Problem

TOKEN = re.compile(
    r"""(?P<comment>/\*.*?\*/|//[^\n]*)
      | (?P<directive>^[ \t]*\#(?:\\\n|/\*.*?\*/|[^\n])*)
      | (?P<text>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
      | (?P<name>[A-Za-z_]\w*)
      | (?P<number>\.?\d(?:[eEpP][+-]|[\w.])*)
      | (?P<space>\s+)
      | (?P<sign>->|.)""", re.X | re.S | re.M)
DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(\w*)[ \t]*(.*)", re.S)
INCLUDED = re.compile(r'([<"])([^>"]+)[>"]')
TEMPLATE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+_template\.h)".*\n', re.M)
OURS = re.compile(r"(pel|PEL)(_|$)")
WORD = re.compile(r"[A-Za-z_]\w*")
KEYWORDS = set("""auto break case char const continue default do double else enum extern float for
    goto if inline int long register return short signed sizeof static struct switch typedef union
    unsigned void volatile while restrict _Static_assert defined""".split())
TYPE_WORDS = {"struct", "union", "enum"}

Include = collections.namedtuple("Include", "name system conditional")


class Code(str):
    """A word or sign outside comments; `conditional` if it stands under an #if."""
    conditional = False


def is_name(word):
    return bool(WORD.match(word)) and word not in KEYWORDS


def read(path):
    """The text of a file with the templates that it includes in their places."""
    def template(match):
        for folder in path.parents:
            if (folder / match.group(1)).is_file():
                return read(folder / match.group(1))
        raise Problem(f"{path.name}: where is {match.group(1)}?")

    return TEMPLATE.sub(template, path.read_text(encoding="utf-8"))


class File:
    """A source or a header: its tokens, what it includes, and the names that it declares."""

    def __init__(self, path, where):
        self.path, self.where = path, where
        self.is_source = path.suffix == ".c"
        self.tokens = [(match.lastgroup, match.group())
                       for match in TOKEN.finditer(read(path))]
        self.words = set()
        self.macros = {}    # {name: words of its text, of every #define there is}
        self.includes = {}  # by the index of the token
        self.headers = []   # the private ones, (File, conditional), filled in by Library
        self.guard = self.find_guard()
        self.code = []
        self.scan()
        self.names, self.exported = set(), {}

    def declare(self, macros):
        """Finds the declared names; `macros` are those of all files that this one sees."""
        try:
            declared = Declarations(self.code, macros)
        except Problem as problem:
            raise Problem(f"{self.where}: {problem}") from None
        self.names, self.exported = declared.names, declared.exported

    def directives(self):
        """(index, keyword, rest) of each line that begins with #."""
        for index, (kind, value) in enumerate(self.tokens):
            if kind == "directive":
                yield index, *DIRECTIVE.match(value).groups()

    def find_guard(self):
        """The macro that keeps a header from being read twice, None if there is none."""
        lines = [(keyword, rest.split()[:1]) for _, keyword, rest in self.directives()]
        around = [index for index, (kind, _) in enumerate(self.tokens)
                  if kind not in ("comment", "space")]
        guarded = len(lines) > 2 and lines[0][0] == "ifndef" and lines[-1][0] == "endif" and \
            lines[1] == ("define", lines[0][1]) and \
            all(self.tokens[index][0] == "directive" for index in (around[0], around[-1]))
        return lines[0][1][0] if guarded and not self.is_source else None

    def scan(self):
        """Reads the tokens once: words, macros, includes, and how deep the #if lines go."""
        lines = {index: (keyword, rest) for index, keyword, rest in self.directives()}
        depth = outside = -1 if self.guard else 0
        pushed = 0
        for index, (kind, value) in enumerate(self.tokens):
            if kind == "directive":
                keyword, rest = lines[index]
                depth += keyword.startswith("if") - (keyword == "endif")
                pushed += self.take_directive(index, keyword, rest, depth > 0, pushed)
            elif kind not in ("comment", "space"):
                self.code.append(Code(value))
                self.code[-1].conditional = depth > 0
                if kind == "name":
                    self.words.add(value)
        if depth != outside:
            raise Problem(f"{self.where}: an #if is not closed")
        if pushed:
            raise Problem(f"{self.where}: a #pragma is pushed and not popped")
        self.macros.pop(self.guard, None)

    def take_directive(self, index, keyword, rest, conditional, pushed):
        """One line; the answer is by how much the stack of pragmas grows."""
        if keyword == "include":
            found = INCLUDED.match(rest)
            if not found:
                raise Problem(f"{self.where}: cannot read #include {rest}")
            self.includes[index] = Include(found.group(2), found.group(1) == "<", conditional)
            return 0
        if keyword == "pragma":
            if re.search(r"\b(target|optimize|diagnostic (?!push|pop))", rest) and not pushed:
                raise Problem(f"{self.where}: '#pragma {rest.strip()}' would reach the files "
                              "behind it; push and pop it")
            return len(re.findall(r"\bpush", rest)) - len(re.findall(r"\bpop", rest))
        words = WORD.findall(re.sub(r"/\*.*?\*/", " ", rest, flags=re.S))
        self.words.update(words)
        if keyword == "define":
            self.macros.setdefault(words[0], set()).update(words[1:])
        return 0

    def own_names(self):
        """The names and macros that may be changed: those without the library's prefix."""
        return {name for name in self.names | set(self.macros) if not OURS.match(name)}


def matching(code, start, opening, closing):
    """The index behind the bracket that closes the one at `start`."""
    depth = 0
    for index in range(start, len(code)):
        depth += (code[index] == opening) - (code[index] == closing)
        if depth == 0:
            return index + 1
    raise Problem(f"a {opening} is not closed, or closed twice under #if and #else")


def without_attributes(code):
    out = []
    index = 0
    while index < len(code):
        if code[index] in ("__attribute__", "_Pragma") and code[index + 1:index + 2] == ["("]:
            index = matching(code, index + 1, "(", ")")
        else:
            out.append(code[index])
            index += 1
    return out


class Declarations:
    """The names declared at file scope. `exported` has those that the linker sees, and whether each
    of their definitions stands under a condition."""

    def __init__(self, code, macros):
        self.names, self.exported = set(), {}
        self.macros = macros
        code = without_attributes(code)
        statement = []
        index = 0
        while index < len(code):
            word = code[index]
            index += 1
            if word == "{" and statement[:1] == ["extern"] and len(statement) == 2:
                statement = []  # extern "C"
            elif word == "{":
                end = matching(code, index - 1, "{", "}")
                if "(" in statement and "=" not in statement:
                    self.take(statement, defined=True)
                    statement = []
                else:
                    self.take_type(statement, code[index:end - 1])
                    statement.append("{}")
                index = end
            elif word in (";", "}"):
                self.take(statement, defined=False)
                statement = []
            else:
                statement.append(word)

    def expanded(self, word, within=()):
        """The words that a macro may stand for, such as the static of an INLINE."""
        words = self.macros.get(word, set()) - set(within)
        return words.union(*(self.expanded(other, (word, *within)) for other in words))

    def take_type(self, statement, body):
        """The tag of a struct, union or enum, and the constants of an enum."""
        heads = [word for word in statement if word in TYPE_WORDS]
        if not heads or "=" in statement:
            return
        if heads[-1] == "enum":
            self.names.update(word for before, word in zip(["{"] + body, body)
                              if before in ("{", ",") and is_name(word))
        if is_name(statement[-1]):
            self.names.add(statement[-1])

    def take(self, statement, defined):
        """The names of one declaration: of a function, variables or a type."""
        depth = 0
        in_value = has_value = False
        found = []
        for place, word in enumerate(statement):
            following = statement[place + 1] if place + 1 < len(statement) else ";"
            if word in ("(", "["):
                depth += 1
            elif word in (")", "]"):
                depth -= 1
            elif depth == 0 and word == "=":
                in_value = has_value = True
            elif depth == 0 and word == ",":
                in_value = False
            elif not in_value and is_name(word) and word not in self.macros and (
                    depth == 0 and following in ("(", "[", "=", ";", ",")
                    or depth == 1 and is_pointer(statement, place)):
                found.append(word)
        self.names.update(found)
        words = set(statement).union(*(self.expanded(word) for word in statement))
        if not {"static", "typedef"} & words and (defined or has_value):
            for name in found:
                self.exported[name] = self.exported.get(name, True) and statement[0].conditional


def is_pointer(statement, place):
    """Whether the word is the name in (*name) or (*const name)."""
    before = place - 1
    stars = 0
    while statement[before] in ("*", "const", "volatile", "restrict"):
        stars += statement[before] == "*"
        before -= 1
    return stars > 0 and statement[before] == "("


class Library:
    """The sources in their order, the private headers that they include, the public headers."""

    def __init__(self, root):
        self.root = root
        self.src, self.include = root / "lib/src", root / "lib/include"
        self.known = {}
        self.sources = [self.file(path) for path in project.sources(root)]
        for file in self.known.values():
            macros = {}
            for name, words in (item for seen in self.seen_from(file)
                                for item in seen.macros.items()):
                macros[name] = macros.get(name, set()) | words
            file.declare(macros)
        self.public = {path.relative_to(self.include).as_posix(): File(path, path.name)
                       for path in project.public_headers(root)}
        self.public_words = set().union(*(file.words for file in self.public.values()))

    def file(self, path):
        """Reads a private file once, and what it includes."""
        if path not in self.known:
            file = self.known[path] = File(path, path.relative_to(self.root / "lib").as_posix())
            for include in file.includes.values():
                header = self.private(file, include)
                if header:
                    file.headers.append((header, include.conditional))
        return self.known[path]

    def private(self, file, include):
        """The private header that an #include line names; None if it names another kind."""
        if is_public(include.name) or include.system:
            return None
        for folder in (file.path.parent, self.src):
            if (folder / include.name).is_file():
                header = self.file((folder / include.name).resolve())
                if not header.guard:
                    raise Problem(f"{header.where} has no include guard")
                return header
        raise Problem(f"{file.where}: where is {include.name}?")

    def seen_from(self, file):
        """The file and every private header that it includes, however far down."""
        seen = [file]
        for header, _ in file.headers:
            seen += [other for other in self.seen_from(header) if other not in seen]
        return seen


def is_public(name):
    return name == "pel.h" or name.startswith("pel/")


def check_exports(library):
    """What the linker sees has the prefix and is defined once, or each time under a condition."""
    exported = {}
    for file in library.known.values():
        for name, conditional in file.exported.items():
            if not OURS.match(name):
                raise Problem(f"{file.where}: {name} is seen by the linker without the prefix pel_")
            where, other = exported.setdefault(name, (file.where, conditional))
            if where != file.where and not (conditional and other):
                raise Problem(f"{name} is defined for the linker in {where} and in {file.where}")


def check_macros(library):
    """Macros with the prefix keep their name, and a header is written once for all that see it."""
    for file in library.known.values():
        for name in sorted(name for name in file.macros if OURS.match(name)):
            others = [] if file.is_source else [
                other.where for other in library.known.values()
                if file not in library.seen_from(other) and name in other.words]
            if others or name in library.public_words:
                raise Problem(f"the macro {name} of {file.where} is also a word of "
                              f"{', '.join(others) or 'the public headers'}")
        if file.is_source:
            for header in library.seen_from(file)[1:]:
                for name in sorted(set(file.macros) & header.words):
                    raise Problem(f"{header.where} depends on the macro {name} of {file.where}")


def choose_names(library):
    """{file: {old name: new name}} for the names that a file declares."""
    files = list(library.known.values())
    taken = library.public_words.union(*(file.words for file in files))
    sees = {other: library.seen_from(other) for other in files}
    renamed = {}
    for file in files:
        renamed[file] = {}
        prefix = file.path.stem if file.is_source else f"{file.path.stem}_h"
        for name in sorted(file.own_names()):
            strangers = [other for other in files
                         if file not in sees[other] and name in other.words]
            if not strangers and name not in library.public_words:
                continue
            new = f"{prefix}_{name}"
            if name.isupper():
                new = new.upper()
            if new in taken:
                raise Problem(f"{file.where}: {name} cannot become {new}, which is taken")
            taken.add(new)
            renamed[file][name] = new
    return renamed


def render(file, changes, included):
    """The text with names changed. Members keep theirs: x.name, x->name, { int name; }. What stands
    in the place of an #include line is up to `included`."""
    out = []
    braces = []  # for every open brace whether it is that of a struct or union
    head = []    # the code since the last brace or semicolon
    before = ""
    for index, (kind, value) in enumerate(file.tokens):
        if kind == "directive":
            if index in file.includes:
                value = included(file.includes[index], value)
            elif DIRECTIVE.match(value).group(1) != "pragma":
                value = WORD.sub(lambda match: changes.get(match.group(), match.group()), value)
            out.append(value)
            continue
        if kind == "name" and value in changes and before not in (".", "->") and not (
                braces and braces[-1] and is_member(file.tokens, index, before)):
            value = changes[value]
        out.append(value)
        if kind in ("space", "comment"):
            continue
        if value == "{":
            braces.append(bool(TYPE_WORDS - {"enum"} & set(head)) and "=" not in head
                          and "(" not in head)
        elif value == "}" and braces:
            braces.pop()
        head = [] if value in ("{", "}", ";") else head + [value]
        before = value
    return "".join(out)


def without_gaps(text):
    """One empty line where #include lines left several."""
    return re.sub(r"\n{3,}", "\n\n", text)


def is_member(tokens, index, before):
    """Whether the name at `index` between a struct's braces is a member and not a type or size."""
    following = next((text for kind, text in tokens[index + 1:]
                      if kind not in ("space", "comment")), "")
    return following in (";", ",", "[", ":") or (before == "*" and following == ")")


class Writer:
    """Puts the files one behind the other, each private header where it is needed first."""

    def __init__(self, library):
        self.library = library
        self.renamed = choose_names(library)
        self.system = set()  # headers of the compiler that every machine has
        self.macros = {}     # of headers written so far, without the prefix: {name: header}

    def section(self, file, done):
        """The text of a file that is not yet in `done`, its headers in front of it."""
        if file in done:
            return ""
        done.add(file)
        before = "".join(self.section(header, done) for header, conditional in file.headers
                         if not conditional)
        body = render(file, self.changes(file),
                      lambda include, line: self.included(file, include, line, done))
        body = without_gaps(body).strip("\n")
        title = f"/* ==== {file.where} {'=' * (87 - len(file.where))} */"
        return f"{before}\n{title}\n\n{body}\n{self.undefs(file)}"

    def changes(self, file):
        """The new names of all that a file declares and sees."""
        changes = {}
        for seen in self.library.seen_from(file):
            for name, new in self.renamed[seen].items():
                if changes.get(name, new) != new:
                    raise Problem(f"{file.where}: {name} comes from two files")
                changes[name] = new
        return changes

    def included(self, file, include, line, done):
        """What stands in the place of an #include line."""
        if include.system and not is_public(include.name):
            if not include.conditional:
                self.system.add(include.name)
                return ""
            seen = self.library.seen_from(file)
            foreign = [name for name, header in self.macros.items() if header not in seen]
            if foreign:
                raise Problem(f"{file.where} includes <{include.name}> behind the macros "
                              f"{', '.join(foreign)} of other files: list it before them")
            return line
        header = self.library.private(file, include)
        if not header or not include.conditional:
            return ""
        # Its guard decides at compile time whether it was read, so `done` learns nothing from it.
        return self.section(header, set(done))

    def undefs(self, file):
        """Ends the macros of a source; remembers those of a header."""
        names = {self.renamed[file].get(name, name) for name in file.macros}
        if file.is_source:
            return "".join(f"#undef {name}\n" for name in sorted(names))
        self.macros.update({name: file for name in names if not OURS.match(name)})
        return ""


def public_header(library, name, done):
    """pel.h with the headers that it includes in the places where it does, each once."""
    done.add(name)
    file = library.public[name]

    def included(include, line):
        if include.system and not is_public(include.name):
            return line
        if include.conditional or include.name not in library.public:
            raise Problem(f"{name}: cannot include {include.name} in a single file")
        return "" if include.name in done else public_header(library, include.name, done)

    return without_gaps(render(file, {}, included))


def top(root, what):
    licence = (root / "LICENSE").read_text(encoding="utf-8").strip()
    lines = [f"pel {project.version(root)}, {what}.", "Written by tools/dev/amalgamate.py: change "
             "the sources, not this file.", ""] + licence.splitlines()
    return "/*\n" + "".join(f" * {line}".rstrip() + "\n" for line in lines) + " */\n"


def amalgamate(root):
    """{file name: text} of pel.h and pel.c."""
    library = Library(root)
    done = set()
    header = public_header(library, "pel.h", done)
    if set(library.public) != done:
        raise Problem(f"pel.h does not include {', '.join(sorted(set(library.public) - done))}")
    check_exports(library)
    check_macros(library)
    writer = Writer(library)
    done = set()
    source = "".join(writer.section(file, done) for file in library.sources)
    system = "".join(f"#include <{name}>\n" for name in sorted(writer.system))
    return {"pel.h": top(root, "header of the single-file library") + header,
            "pel.c": top(root, "the whole library in one file") + '#include "pel.h"\n'
                     + (f"\n{system}" if system else "") + source}


def main():
    parser = argparse.ArgumentParser(description="Writes pel.c and pel.h.")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=project.HERE)
    arguments = parser.parse_args()
    try:
        texts = amalgamate(arguments.root.resolve())
        arguments.out.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (arguments.out / name).write_text(text, encoding="utf-8")
    except (OSError, Problem) as problem:
        print(f"amalgamate.py: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
