"""What editors and readers of the manual see."""
import ast
import inspect
import os
import pathlib
import re

import triad
from triad import _triad

FOLDER = pathlib.Path(triad.__file__).parent
PAGE = pathlib.Path(__file__).parents[2] / "docs" / "python.md"


def test_stubs_say_what_the_module_has():
    stub = ast.parse((FOLDER / "_triad.pyi").read_text())

    def public(names):
        return {name for name in names if not name.startswith("_")}

    said = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(said) == public(dir(_triad))
    for name, node in said.items():
        if not isinstance(node, ast.ClassDef) or name == "Error":
            continue
        members = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        assert public(members) == public(dir(getattr(_triad, name))), name
    assert (FOLDER / "py.typed").exists()


def test_everything_public_has_a_docstring_and_types():
    for name in triad.__all__:
        thing = getattr(triad, name)
        if thing.__module__ == "triad._triad":
            continue  # in the stubs
        assert thing.__doc__, name
        if inspect.isfunction(thing):
            signature = inspect.signature(thing)
            for parameter in signature.parameters.values():
                assert parameter.annotation is not parameter.empty, f"{name}({parameter.name})"
            assert signature.return_annotation is not signature.empty, name


def test_examples_of_the_page_run():
    blocks = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 4
    names = {}
    for block in blocks:  # in order: later ones use what earlier ones made
        exec(compile(block, str(PAGE), "exec"), names)
    for picture in re.findall(r'write\("([^"]+)"', "".join(blocks)):
        assert os.path.getsize(picture) > 0
