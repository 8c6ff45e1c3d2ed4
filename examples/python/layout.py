#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""layout.py OUTPUT HEADER...: writes the enums, structs and functions of C headers as a Python module for ctypes.

Reads what glssao.h and its neighbours are written in, not all of C: typedefs of enums, structs, opaque structs and
function pointers, and function declarations.
"""
import re
import sys
from contextlib import redirect_stdout
from os.path import commonprefix

types = {
    "bool": "c_bool", "int": "c_int", "size_t": "c_size_t", "uint32_t": "c_uint32", "uint64_t": "c_uint64",
    "float": "c_float", "double": "c_double", "char": "c_char", "void": "None",
}  # from a C type to the name of its ctypes type
enums, opaque, constants = set(), set(), {}


def translate(words, stars):
    """The ctypes type of a C type name and its asterisks."""
    name = re.sub(r"\b(const|struct|enum)\b", "", words).strip()
    if name in opaque or name == "void":
        stars -= 1
        base = "c_void_p" if stars >= 0 else "None"
    elif name == "char":
        stars -= 1
        base = "c_char_p" if stars >= 0 else "c_char"
    else:
        base = "c_int" if name in enums else types.get(name, name)
    return "POINTER(" * max(stars, 0) + base + ")" * max(stars, 0)


def split_declarator(text):
    """"const float color[3]" as type words, number of asterisks, name, array sizes."""
    words, stars, name, sizes = re.fullmatch(r"([\w ]+?)\s*(\**)\s*(\w+)((?:\[\w+\])*)", text.strip()).groups()
    return words, len(stars), name, re.findall(r"\[(\w+)\]", sizes)


def parameters(text):
    """The ctypes types of a function's parameters. An array is a pointer."""
    if text.strip() in ("void", ""):
        return []
    parts = [split_declarator(part) for part in text.split(",")]
    return [translate(words, stars + (1 if sizes else 0)) for words, stars, _, sizes in parts]


def write_enum(name, body):
    value, members = -1, []
    for item in filter(None, (item.strip() for item in body.split(","))):
        key, _, given = (part.strip() for part in item.partition("="))
        value = int(given, 0) if given else value + 1
        constants[key] = value
        members.append((key, value))
    prefix = commonprefix([key for key, _ in members]).rpartition("_")[0] + "_"
    print(f"\n\nclass {name}(IntEnum):")
    for key, number in members:
        print(f"    {key[len(prefix):]} = {number}")


def write_struct(name, body):
    fields, of_enums = [], []
    for line in filter(None, (line.strip() for line in body.split(";"))):
        if "(" in line:  # a function pointer
            fields.append((re.search(r"\(\*(\w+)\)", line)[1], "c_void_p"))
            continue
        first, *others = line.split(",")
        words, stars, field, sizes = split_declarator(first)
        for field, sizes in [(field, sizes)] + [split_declarator("int " + other)[2:] for other in others]:
            kind = translate(words, stars)
            for size in reversed(sizes):
                kind += f" * {constants.get(size, size)}"
            fields.append((field, kind))
            if words in enums:
                of_enums.append(f'"{field}": {words}')
    print(f"\n\nclass {name}(Structure):")
    print("    _fields_ = [")
    for field, kind in fields:
        print(f'        ("{field}", {kind}),')
    print("    ]")
    print(f"    enums: dict[str, type[IntEnum]] = {{{', '.join(of_enums)}}}")
    types[name] = name


def main(paths):
    text = "\n".join(open(path, encoding="utf-8").read() for path in paths)
    version = re.findall(r"#define GLSSAO_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text)
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r"^\s*#.*$", "", text, flags=re.MULTILINE).replace('extern "C" {', "").replace("GLSSAO_API", "")
    text = re.sub(r"\s+", " ", text)

    print('"""Generated from the C headers by layout.py."""\nfrom __future__ import annotations\n')
    print("from ctypes import (CFUNCTYPE, POINTER, Structure, c_bool, c_char_p, c_double, c_float, c_int, c_size_t,")
    print("                    c_uint32, c_uint64, c_void_p)")
    print("from enum import IntEnum")
    print(f'\nVERSION = "{".".join(version)}"')

    opaque.update(re.findall(r"typedef struct (\w+) \1 ?;", text))
    enums.update(re.findall(r"typedef enum (\w+)", text))
    for result, name, rest in re.findall(r"typedef ([\w ]+\**) ?\(\*(\w+)\)\(([^)]*)\);", text):
        words, stars = result.rstrip("* "), result.count("*")
        arguments = "".join(", " + kind for kind in parameters(rest))
        print(f"\n{name} = CFUNCTYPE({translate(words, stars)}{arguments})")
    structs = set(re.findall(r"\} (\w+);", text))
    block = re.compile(r"(struct|enum) (\w+) \{([^{}]*)\}")
    while found := block.search(text):  # the innermost first, which outer ones then name
        kind, name, body = found.groups()
        (write_enum if kind == "enum" else write_struct)(name, body)
        text = text[:found.start()] + name + text[found.end():]

    print("\n\nSTRUCTS = [", ", ".join(name for name in types if name in structs), "]", sep="")
    print("\nFUNCTIONS = {  # name: type of the result, types of the parameters")
    for result, name, rest in re.findall(r"(?<=[;}]) ((?:const )?\w+ \**)(\w+)\(([^()]*)\)(?=;)", text):
        print(f'    "{name}": ({translate(result.rstrip("* "), result.count("*"))}, [{", ".join(parameters(rest))}]),')
    print("}")


with open(sys.argv[1], "w", encoding="utf-8") as output, redirect_stdout(output):
    main(sys.argv[2:])
