"""The C++ reference: what Doxygen read in the headers, as a Markdown page a folder.

Breathe would do the same; with some 350 headers in three namespaces it takes minutes and warns of each namespace once a
header, so that a site with warnings as errors could not be built. Declarations and docstrings are shown as they stand.
"""

import re
import xml.etree.ElementTree as ElementTree

KINDS = ("class", "struct", "enum", "function", "typedef", "variable")
PUBLIC = ("public-type", "public-attrib", "public-static-attrib", "public-func", "public-static-func", "friend")


def plain(node):
    """A docstring as Markdown, a paragraph a paragraph."""
    if node is None:
        return ""
    parts = []
    for paragraph in node.iter("para"):
        if any(child.tag == "para" for child in paragraph.iter() if child is not paragraph):
            continue
        for code in paragraph.iter("computeroutput"):
            code.text, code[:] = f"`{''.join(code.itertext())}`", ()
        parts.append(" ".join("".join(paragraph.itertext()).split()))
    return "\n\n".join(escaped(part) for part in parts if part)


def escaped(text):
    """Only what stands between backquotes is meant as Markdown."""
    return "".join(
        part if part.startswith("`") else re.sub(r"([\\*_<>\[\]$|#{}])", r"\\\1", part)
        for part in re.split(r"(`[^`]*`)", text)
    )


def words(node):
    return " ".join("".join(node.itertext()).split()) if node is not None else ""


def declaration(member):
    """As in the header, without the namespaces."""
    kind = member.get("kind")
    template = member.find("templateparamlist")
    head = ""
    if template is not None:
        parameters = (" ".join(filter(None, (words(p.find("type")), words(p.find("declname"))))) for p in template)
        head = f"template <{', '.join(parameters)}>\n"
    type_, name = words(member.find("type")), member.findtext("name")
    if kind == "enum":
        values = ", ".join(value.findtext("name") for value in member.findall("enumvalue"))
        return f"enum class {name} {{ {values} }};"
    if kind == "typedef":
        return f"{head}using {name} = {type_};"
    text = head + ("static " if member.get("static") == "yes" else "") + (f"{type_} " if type_ else "") + name
    text += member.findtext("argsstring") or ""
    if kind == "variable":
        text += (" " + words(member.find("initializer"))).rstrip()
    return tidy(text) + ";"


def tidy(text):
    """As the sources are formatted."""
    text = re.sub(r" ([&*]+) ?", r"\1 ", text)
    text = re.sub(r"([&*]) (?=[,)>])", r"\1", text)
    text = re.sub(r"(?<=\d) '(?=\d)", "'", text)
    return text.replace("< ", "<").replace(" >", ">").replace("=default", "= default")


def documented(member):
    text = plain(member.find("briefdescription"))
    more = plain(member.find("detaileddescription"))
    values = [(v.findtext("name"), plain(v.find("briefdescription")) or plain(v.find("detaileddescription")))
              for v in member.findall("enumvalue")]
    lines = [part for part in (text, more) if part]
    lines += [f"- `{name}`: {says}" for name, says in values if says]
    return "\n\n".join(lines)


def entry(title, code, text, level):
    return f"{'#' * level} {escaped(title)}\n\n```cpp\n{code}\n```\n\n{text}\n\n"


def short(qualified):
    """folk::sct::Planner as sct::Planner."""
    return qualified.removeprefix("folk::")


class Reference:
    """All of Doxygen's XML, by header."""

    def __init__(self, folder):
        self.of_header = {}
        for path in sorted(folder.glob("*.xml")):
            compound = ElementTree.parse(path).getroot().find("compounddef")
            if compound is None or compound.get("prot") in ("private", "protected"):
                continue
            if compound.get("kind") in ("class", "struct"):
                self.add(compound, compound.find("location").get("file"), self.type_entry(compound))
            elif compound.get("kind") == "namespace":
                for member in compound.iter("memberdef"):
                    title = short(member.findtext("qualifiedname") or member.findtext("name"))
                    self.add(member, member.find("location").get("file"),
                             entry(title, declaration(member), documented(member), 3))

    def add(self, node, header, text):
        line = int(node.find("location").get("line", 0))
        self.of_header.setdefault(header, []).append((line, text))

    def type_entry(self, compound):
        name = short(compound.findtext("compoundname"))
        bases = ", ".join(words(base) for base in compound.findall("basecompoundref"))
        code, members = [], []
        for section in compound.findall("sectiondef"):
            if section.get("kind") not in PUBLIC:
                continue
            for member in section.findall("memberdef"):
                if member.get("prot") != "public" or "delete" in (member.findtext("argsstring") or ""):
                    continue
                says = documented(member)
                code.append("  " + declaration(member).replace("\n", "\n  "))
                if says:
                    members.append(f"- `{member.findtext('name')}`: " + says.replace("\n\n", "\n\n  "))
        head = f"{compound.get('kind')} {name.split('::')[-1]}{' : ' + bases if bases else ''}"
        body = head + (" {\n" + "\n".join(code) + "\n};" if code else ";")
        return entry(name, body, documented(compound) + "\n\n" + "\n".join(members), 3)

    def page(self, root, folder):
        """The folder's page: header by header, each with the comment that it begins with."""
        text = f"# {escaped(folder.relative_to(root).as_posix())}\n\n"
        for header in sorted(folder.glob("*.h")):
            path = header.relative_to(root).as_posix()
            text += f"## {escaped(header.name)}\n\n`#include <folk/{path}>`\n\n{escaped(first_comment(header))}\n\n"
            text += "".join(said for _, said in sorted(self.of_header.get(path, ())))
        return text


def first_comment(header):
    lines = header.read_text(encoding="utf-8").splitlines()
    said = []
    for line in lines[1:] if lines[0] == "#pragma once" else lines:
        if not line.startswith("//"):
            break
        said.append(line.removeprefix("//").strip())
    return " ".join(said)
