#!/usr/bin/env python3
"""page_code.py PAGE.md FOLDER: the examples of a page of the manual as files that can be run.

The block of CMake becomes CMakeLists.txt, the block of C++ with a main() main.cpp; what other blocks of C++ hold are
bodies of functions, which page.cpp calls in turn.
"""
import pathlib
import re
import sys


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


def main(page, folder):
    text = pathlib.Path(page).read_text()
    folder = pathlib.Path(folder)
    (cmake,) = blocks(text, "cmake")
    (program,) = [block for block in blocks(text, "cpp") if "int main" in block]
    bodies = [block for block in blocks(text, "cpp") if "int main" not in block]
    assert bodies, "no examples"
    (folder / "CMakeLists.txt").write_text(cmake)
    (folder / "main.cpp").write_text(program)
    functions = "".join(f"void example_{i}() {{\n{body}}}\n" for i, body in enumerate(bodies))
    calls = "".join(f"    example_{i}();\n" for i in range(len(bodies)))
    (folder / "page.cpp").write_text(
        f"#include <triad/triad.h>\n\n#include <cstdio>\n#include <vector>\n\n{functions}\nint main() {{\n{calls}}}\n")


main(*sys.argv[1:])
