#!/usr/bin/env python3
"""validate_json.py SCHEMA FILE [--lines]: says where FILE, or each of its lines, is not what docs/schema/SCHEMA.schema.json
describes, and exits with 1. Without jsonschema (Debian: python3-jsonschema): exit 77."""
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    sys.exit(77)

folder = pathlib.Path(__file__).resolve().parent.parent / "docs" / "schema"
schemas = {path.as_uri(): json.loads(path.read_text()) for path in folder.glob("*.schema.json")}
uri = (folder / (sys.argv[1] + ".schema.json")).as_uri()
schema = schemas[uri]
jsonschema.Draft202012Validator.check_schema(schema)
resolver = jsonschema.RefResolver(base_uri=uri, referrer=schema, store=schemas)
validator = jsonschema.Draft202012Validator(schema, resolver=resolver)


def complaints(errors):
    """The innermost: of alternatives those of the one that fits best."""
    for error in errors:
        if error.context:
            error = jsonschema.exceptions.best_match([error])
        yield "%s: %s" % (error.json_path, error.message[:500])


text = pathlib.Path(sys.argv[2]).read_text()
documents = [line for line in text.splitlines() if line.startswith("{")] if "--lines" in sys.argv else [text]
found = [c for document in documents for c in complaints(validator.iter_errors(json.loads(document)))]
print("\n".join(found[:20]))
sys.exit(bool(found) or not documents)
