#!/usr/bin/env python3
"""python_reference.py FOLDER: the reference of the Python package, from its own documents and hints alone.

The modules are read and not imported, so that nothing has to be compiled or installed. The pages of PAGES show the public
names of its modules: those of froe.__all__ in the module where they are made, and of the others all that do not begin with
"_". Of each they show the signature with its hints, the text, and tables of what the text says in fields:

    :param NAME: an argument     :ivar NAME: an attribute     :returns: what comes out
    :raises NAME: when           :cost: time and memory       >>> an example

python/tests/test_reference.py compares the pages with the package as it is imported.
"""
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ROOT / "python/src"
# The pages: their titles and modules. The names of a module in OF_FROE are called as names of froe.
PAGES = {
    "scenes": ("Scenes", ["scene", "scene_parts"]),
    "trees": ("Trees and answers", ["tree", "parts", "answers", "report"]),
    "pictures": ("Pictures", ["pictures", "mpl"]),
    "motion": ("Motion", ["motion"]),
    "adapters": ("Geometries and meshes of other libraries",
                 ["adapters.shapely", "adapters.geopandas", "adapters.geojson", "adapters.meshes"]),
    "replacements": ("In place of shapely, trimesh and pyvista", ["compat.shapely", "compat.trimesh", "compat.pyvista"]),
    "measures": ("Measures", ["measure"]),
    "errors": ("Exceptions", ["errors"]),
}
OF_FROE = {"scene", "scene_parts", "tree", "parts", "answers", "report", "pictures", "motion", *PAGES["adapters"][1]}
FOR_THE_EXTENSION = {"of_status", "of_name"}  # which calls them by these names
WIDTH = 88
FIELD = re.compile(r"^:(param|ivar|returns|raises|cost)(?: ([^:]+))?: ?", re.M)
TITLES = {"param": "argument", "ivar": "attribute", "returns": "returns", "raises": "raises", "cost": "cost"}


class Name:
    """A public name: its path such as Tree.query, its signature, its text, and the names within it."""

    def __init__(self, path, signature, text, inner=()):
        self.path, self.signature, self.text, self.inner = path, signature, text, inner


def public(name):
    return not name.startswith("_")


def decorated(node, name):
    return any(ast.unparse(one).split("(")[0].split(".")[-1] == name for one in node.decorator_list)


def hint(annotation):
    text = ast.unparse(annotation).replace("npt.", "").replace("np.", "")
    return text.replace("os.PathLike[str]", "PathLike").replace("None | None", "None")


def arguments(function):
    """Each argument as it is written, with `*` where the rest is given by name."""
    given, found = function.args, []
    positional = [*given.posonlyargs, *given.args]
    defaults = [None] * (len(positional) - len(given.defaults)) + given.defaults

    def one(argument, default, stars=""):
        text = stars + argument.arg + (f": {hint(argument.annotation)}" if argument.annotation else "")
        return text + (f" = {ast.unparse(default)}" if default else "")

    found += [one(*pair) for pair in zip(positional, defaults) if pair[0].arg not in ("self", "cls")]
    if given.vararg:
        found.append(one(given.vararg, None, "*"))
    elif given.kwonlyargs:
        found.append("*")
    found += [one(*pair) for pair in zip(given.kwonlyargs, given.kw_defaults)]
    return found + ([one(given.kwarg, None, "**")] if given.kwarg else [])


def signature(path, function):
    """On one line, or an argument on each."""
    result = f" -> {hint(function.returns)}" if function.returns else ""
    parts = arguments(function)
    line = f"{path}({', '.join(parts)}){result}"
    return line if len(line) <= WIDTH else "\n".join([f"{path}(", *(f"    {part}," for part in parts), f"){result}"])


def of_function(path, versions):
    """A function or method. Of several versions with @overload all but the last are shown."""
    shown = [one for one in versions if decorated(one, "overload")] or versions
    return Name(path, "\n".join(signature(path, one) for one in shown), ast.get_docstring(versions[-1]))


def classes():
    """All classes of the package by name."""
    trees = [ast.parse(source.read_text(encoding="utf-8")) for source in sorted(SOURCES.glob("froe/**/*.py"))]
    return {node.name: node for tree in trees for node in tree.body if isinstance(node, ast.ClassDef)}


def of_class(node, prefix, known):
    """A class with its methods and those of its base classes. The fields of a dataclass are its signature."""
    path, inner, methods = f"{prefix}.{node.name}", [], {}
    fields = [one for one in node.body if isinstance(one, ast.AnnAssign)] if decorated(node, "dataclass") else []
    bases = [known[ast.unparse(base)] for base in node.bases if ast.unparse(base) in known]
    for one in [one for kind in (*bases, node) for one in kind.body]:
        if isinstance(one, ast.FunctionDef) and (public(one.name) or one.name == "__init__"):
            methods.setdefault(one.name, []).append(one)
    made = methods.pop("__init__", None)
    for name, versions in methods.items():
        if decorated(versions[0], "property"):
            inner.append(Name(f"{path}.{name}", f"{path}.{name}: {hint(versions[0].returns)}", ast.get_docstring(versions[0])))
        else:
            inner.append(of_function(f"{path}.{name}", versions))
    if fields:
        shown = "\n".join([f"class {path}:", *(f"    {one.target.id}: {hint(one.annotation)}" for one in fields)])
    elif made and "_core." not in ast.unparse(made[-1].args):  # otherwise other functions make it
        shown = "class " + signature(path, made[-1]).removesuffix(" -> None")
    else:
        shown = f"class {path}" + (f"({', '.join(map(ast.unparse, node.bases))})" if node.bases else "")
    return Name(path, shown, ast.get_docstring(node), inner)


def of_module(module, exported, known):
    """The text of a module, and its public names, called as users call them."""
    source = SOURCES / "froe" / (module.replace(".", "/") + ".py")
    tree = ast.parse(source.read_text(encoding="utf-8"))
    prefix = "froe" if module in OF_FROE else f"froe.{module}"
    functions, names = {}, []
    for node in tree.body:
        if not isinstance(node, (ast.FunctionDef, ast.ClassDef)) or not public(node.name):
            continue
        if node.name in FOR_THE_EXTENSION or module in OF_FROE and node.name not in exported:
            continue
        if isinstance(node, ast.ClassDef):
            names.append(of_class(node, prefix, known))
        else:
            functions.setdefault(node.name, []).append(node)
    names += [of_function(f"{prefix}.{name}", versions) for name, versions in functions.items()]
    return ast.get_docstring(tree), names


def exported_names():
    tree = ast.parse((SOURCES / "froe/__init__.py").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return set(ast.literal_eval(node.value))
    raise ValueError("froe has no __all__")


# ------------------------------------------------------------- texts


def marked(text):
    """Words of reStructuredText as Markdown."""
    text = re.sub(r":(?:func|class|meth|mod):`~?([^`]+)`", r"`\1`", text)
    return re.sub(r"``(.+?)``", r"`\1`", text, flags=re.S)


def grid(lines):
    """A table between lines of "=", of two columns."""
    edge = lines[0].index(" ")
    rows = [(line[:edge].strip(), line[edge:].strip()) for line in lines[1:-1]]
    return ["| | |", "|---|---|", *(f"| {marked(left)} | {marked(right)} |" for left, right in rows), ""]


def paragraphs(text):
    """Text, examples and tables."""
    found, lines, at = [], text.split("\n"), 0
    while at < len(lines):
        line = lines[at]
        if line.startswith(">>> "):
            end = at
            while end < len(lines) and lines[end].strip():
                end += 1
            found += ["", "```pycon", *lines[at:end], "```", ""]
            at = end
        elif re.match(r"=+ =+$", line):
            end = at + 1
            while not re.match(r"=+ =+$", lines[end]):
                end += 1
            found += grid(lines[at : end + 1])
            at = end + 1
        else:
            found.append(marked(line))
            at += 1
    return "\n".join(found)


def divided(text):
    """The text without its fields, and the fields: (kind, name, what is said of it)."""
    parts, fields = [], []
    for block in re.split(r"\n\n+", text or ""):
        starts = [match.start() for match in FIELD.finditer(block)]
        if not starts or starts[0] != 0:
            parts.append(block)
            continue
        for begin, end in zip(starts, [*starts[1:], len(block)]):
            match = FIELD.match(block, begin)
            fields.append((match[1], match[2] or "", " ".join(block[match.end() : end].split())))
    return "\n\n".join(parts), fields


def table(fields):
    """One table for each kind of field that has names, and a line for each that has none."""
    lines = []
    for kind in TITLES:
        lines += [f"**{TITLES[kind].capitalize()}:** {marked(text)}\n" for found, name, text in fields
                  if found == kind and not name]
        rows = [(name, text) for found, name, text in fields if found == kind and name]
        if rows:
            lines += [f"| {TITLES[kind]} | |", "|---|---|"]
            lines += [f"| `{name.replace(', ', '`, `')}` | {marked(text)} |" for name, text in rows] + [""]
    return "\n".join(lines)


def anchor(path):
    return path.removeprefix("froe.").lower().replace(".", "-")


def section(name, level):
    text, fields = divided(name.text)
    examples = text.find(">>> ")
    begin = text if examples < 0 else text[:examples]
    rest = "" if examples < 0 else text[examples:]
    parts = [f"{'#' * level} {name.path.removeprefix('froe.') if level == 3 else name.path} {{#{anchor(name.path)}}}",
             f"```python\n{name.signature}\n```", paragraphs(begin).strip(), table(fields), paragraphs(rest).strip()]
    return "\n\n".join([part for part in parts if part] + [section(inner, level + 1) for inner in name.inner])


def first_sentence(text):
    begin = marked((text or "").split("\n\n")[0])
    return re.split(r"(?<=[.:])\s", " ".join(begin.split()))[0].rstrip(":")


INTRODUCTION = """\
Every public name of the package, as its own documents describe it; `help(froe.Tree)` prints the same.
[Python](../../howto/python.md) shows how they are used, and the [tutorials](../../README.md#tutorials) from Python begin
at the beginning.

`ArrayLike` is everything that `numpy.asarray` takes: arrays, lists, columns of tables. `Doubles` is an array of float64,
`Ids` one of int32, in which -1 stands for none. Some arrays that come out are columns of a table, with gaps between their
items; `numpy.ascontiguousarray` copies them. What calls raise beside built-in
exceptions is on the page of [exceptions](errors.md).
"""


def write(folder):
    """The pages. Returns the paths of all names, such as froe.Tree.query."""
    folder.mkdir(parents=True, exist_ok=True)
    exported, known, paths, listing = exported_names(), classes(), [], []
    for page, (title, modules) in PAGES.items():
        parts = [f"# {title}"]
        listing.append(f"\n## {title}\n\n| name | is |\n|---|---|")
        for module in modules:
            text, names = of_module(module, exported, known)
            body, fields = divided(text)
            parts += [paragraphs(body).strip(), table(fields), *(section(name, 2) for name in names)]
            for name in names:
                listing.append(f"| [`{name.path}`]({page}.md#{anchor(name.path)}) | {first_sentence(name.text)} |")
                paths += [name.path, *(inner.path for inner in name.inner)]
        (folder / f"{page}.md").write_text("\n\n".join(filter(None, parts)) + "\n", encoding="utf-8")
    (folder / "README.md").write_text("# Python\n\n" + INTRODUCTION + "\n".join(listing) + "\n", encoding="utf-8")
    return paths


if __name__ == "__main__":
    print("\n".join(write(pathlib.Path(sys.argv[1]))))
