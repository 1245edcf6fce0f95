"""The Python reference: a page a module of folk, for Sphinx's autodoc to fill from the docstrings."""

import importlib
import inspect
import pkgutil
import re

# Modules whose names are not names of folk itself.
NAMESPACES = ("folk.sct", "folk.mpe")


def python_pages(source):
    """In SOURCE/py; says only so where the module is not built."""
    pages = source / "py"
    pages.mkdir()
    title = "# Python reference\n\n"
    try:
        import folk
    except ImportError:
        (pages / "index.md").write_text(
            f"{title}This site was built beside a Folk without its Python package: `cmake -DFOLK_PYTHON=ON` makes it.\n", encoding="utf-8")
        return
    names = []
    for module in public_modules(folk):
        names.append(module.__name__.removeprefix("folk."))
        (pages / f"{names[-1]}.md").write_text(page(folk, module), encoding="utf-8")
    (pages / "errors.md").write_text(
        "# errors\n\n" + directives("folk", [name for name in folk.__all__ if is_error(getattr(folk, name))]), encoding="utf-8")
    listed = "\n".join([*names, "errors"])
    (pages / "index.md").write_text(
        f"{title}Every name of `folk`, module by module, with what it says of itself; [the guide](../docs/python.md) goes before.\n\n"
        f"```{{toctree}}\n:maxdepth: 1\n\n{listed}\n```\n", encoding="utf-8")


def public_modules(package):
    return [importlib.import_module(f"folk.{found.name}") for found in pkgutil.iter_modules(package.__path__)
            if not found.name.startswith("_")]


def is_error(value):
    return inspect.isclass(value) and issubclass(value, Exception)


def page(package, module):
    """What of the module has a name: in folk, or in the module where that is a namespace."""
    said = inspect.getdoc(module)
    home = module if module.__name__ in NAMESPACES else package
    names = [name for name, value in vars(module).items()
             if not name.startswith("_") and getattr(value, "__module__", None) in (module.__name__, "folk")
             and getattr(home, name, None) is value and not is_error(value)]
    return f"# {module.__name__.removeprefix('folk.')}\n\n{said}\n\n" + directives(home.__name__, names)


def directives(home, names):
    """Classes with their members, in the order of the source."""
    module = importlib.import_module(home)
    lines = ["```{eval-rst}", f".. currentmodule:: {home}", ""]
    for name in names:
        value = getattr(module, name)
        if inspect.isclass(value):
            lines += [f".. autoclass:: {name}", *([] if is_error(value) else ["   :members:", "   :inherited-members:"]), ""]
        else:
            lines += [f".. autofunction:: {name}", ""]
    return "\n".join([*lines, "```"]) + "\n"


def without_insides(app, what, name, value, options, signature, returned):
    """Results are made by functions, out of what the library holds."""
    return ("", returned) if signature and signature.startswith(("(held", "(data")) else None


def as_it_stands(app, what, name, value, options, lines):
    """Docstrings are plain text: what is indented keeps its lines, and only `code` is marked."""
    text, before = [], "text"
    for line in lines:
        if line.startswith(">>>") or (before == "example" and line):
            kind = "example"
        elif line.startswith("  ") or (before == "table" and not line):
            kind = "table"
        else:
            kind = "text"
        if kind != before:
            text += ["", "::", ""] if kind == "table" else [""]
        text.append(marked(line) if kind == "text" else line)
        before = kind
    lines[:] = text


def marked(line):
    """`code` as reStructuredText writes it; nothing else means anything."""
    parts = re.split(r"`([^`]+)`", line)
    return "".join(f"``{part}``" if place % 2 else re.sub(r"([*|\\_])", r"\\\1", part) for place, part in enumerate(parts))
