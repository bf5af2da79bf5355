"""A small writer of glTF 2.0: numpy arrays and dictionaries in, one .glb or self-contained .gltf out.

    scene = Gltf()
    red = scene.material("red", pbrMetallicRoughness={"baseColorFactor": [0.6, 0.05, 0.05, 1], "metallicFactor": 0})
    ball = scene.mesh(scene.primitive(**shapes.sphere(), material=red))
    scene.node(mesh=ball, translation=[0, 1, 0])
    scene.node(camera=scene.perspective(yfov=0.7), matrix=look_at([0, 1, 5], [0, 1, 0]))
    scene.write("ball.glb")

Methods return the index of what they added. Members are named as glTF names them and are passed through unchanged,
"extensions" included; extensionsUsed is collected from them. The same calls write the same bytes.
"""
import base64
import json
import struct
import zlib

import numpy

_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_COMPONENTS = {"float32": 5126, "uint32": 5125, "uint16": 5123, "uint8": 5121}
_VERTICES, _INDICES = 34962, 34963  # bufferView.target


def png(pixels):
    """The bytes of a PNG: pixels is height x width x channels (1, 3 or 4), uint8 or uint16, row 0 on top."""
    pixels = numpy.asarray(pixels)
    if pixels.ndim == 2:
        pixels = pixels[..., None]
    height, width, channels = pixels.shape
    if pixels.dtype not in (numpy.uint8, numpy.uint16):
        raise ValueError(f"A PNG holds uint8 or uint16, not {pixels.dtype}.")
    rows = pixels.astype(pixels.dtype.newbyteorder(">")).reshape(height, -1)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)  # filter "none" before each row

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8 * pixels.dtype.itemsize, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def look_at(eye, target, up=(0, 1, 0)):
    """The 4 x 4 matrix of a node whose -z axis goes from eye to target, as cameras and lights look."""
    eye, target, up = (numpy.asarray(v, float) for v in (eye, target, up))
    z = (eye - target) / numpy.linalg.norm(eye - target)
    x = numpy.cross(up, z)
    x /= numpy.linalg.norm(x)
    matrix = numpy.eye(4)
    matrix[:3] = numpy.stack([x, numpy.cross(z, x), z, eye], axis=1)
    return matrix


class Gltf:
    def __init__(self):
        self.document = {"asset": {"version": "2.0", "generator": "Triad scenes/glb.py"}, "scene": 0,
                         "scenes": [{"nodes": []}]}
        self._data = bytearray()

    def _add(self, array, item):
        items = self.document.setdefault(array, [])
        items.append(item)
        return len(items) - 1

    def _view(self, data, target=None):
        self._data += b"\0" * (-len(self._data) % 4)
        view = {"buffer": 0, "byteOffset": len(self._data), "byteLength": len(data)}
        if target:
            view["target"] = target
        self._data += data
        return self._add("bufferViews", view)

    def accessor(self, values, target=None, bounds=False):
        """An array as it is: float32, uint32, uint16 or uint8, of 1 to 4 columns."""
        values = numpy.ascontiguousarray(values)
        columns = values.shape[1] if values.ndim == 2 else 1
        item = {"bufferView": self._view(values.tobytes(), target), "componentType": _COMPONENTS[values.dtype.name],
                "count": len(values), "type": _TYPES[columns]}
        if bounds:
            item.update(min=values.min(axis=0).tolist(), max=values.max(axis=0).tolist())
        return self._add("accessors", item)

    def primitive(self, positions, indices=None, normals=None, tangents=None, uvs=None, uvs1=None, colours=None,
                  material=None):
        """A dictionary for mesh(). Positions and normals n x 3, tangents n x 4, uvs n x 2, colours n x 3 or 4, all stored
        as float32; indices m x 3 or flat. Positions are rounded once: give doubles."""
        item = {"attributes": {}}
        attributes = {"POSITION": positions, "NORMAL": normals, "TANGENT": tangents, "TEXCOORD_0": uvs,
                      "TEXCOORD_1": uvs1, "COLOR_0": colours}
        for name, values in attributes.items():
            if values is not None:
                values = numpy.asarray(values, numpy.float32)
                item["attributes"][name] = self.accessor(values, _VERTICES, bounds=name == "POSITION")
        if indices is not None:
            indices = numpy.asarray(indices).ravel()
            kind = numpy.uint16 if len(positions) <= 65535 else numpy.uint32  # 65535 itself is reserved
            item["indices"] = self.accessor(indices.astype(kind), _INDICES)
        if material is not None:
            item["material"] = material
        return item

    def mesh(self, *primitives, name=None):
        return self._add("meshes", _named(name, primitives=list(primitives)))

    def material(self, name=None, **members):
        return self._add("materials", _named(name, **members))

    def image(self, pixels):
        """pixels: an array as png() takes it, or the bytes of a PNG."""
        data = pixels if isinstance(pixels, bytes) else png(pixels)
        return self._add("images", {"bufferView": self._view(data), "mimeType": "image/png"})

    def texture(self, pixels, **sampler):
        """A texture of its own image; sampler: magFilter, minFilter, wrapS, wrapT."""
        item = {"source": self.image(pixels)}
        if sampler:
            item["sampler"] = self._add("samplers", sampler)
        return self._add("textures", item)

    def perspective(self, yfov, aspect=None, znear=0.01, name=None):
        """yfov in radians."""
        lens = {"yfov": yfov, "znear": znear} | ({"aspectRatio": aspect} if aspect else {})
        return self._add("cameras", _named(name, type="perspective", perspective=lens))

    def orthographic(self, xmag, ymag, znear=0.0, zfar=1e9, name=None):
        lens = {"xmag": xmag, "ymag": ymag, "znear": znear, "zfar": zfar}
        return self._add("cameras", _named(name, type="orthographic", orthographic=lens))

    def light(self, type, name=None, **members):
        """A light of KHR_lights_punctual: type point, spot or directional; color, intensity, range, spot."""
        extension = self.document.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})
        extension["lights"].append(_named(name, type=type, **members))
        return len(extension["lights"]) - 1

    def node(self, mesh=None, camera=None, light=None, translation=None, rotation=None, scale=None, matrix=None,
             children=None, extensions=None, name=None, root=True):
        """matrix: 4 x 4, acting on columns; rotation: quaternion x, y, z, w. Children must have been added with
        root=False."""
        members = {"mesh": mesh, "camera": camera, "translation": translation, "rotation": rotation, "scale": scale,
                   "children": children}
        item = {key: numpy.asarray(value).tolist() for key, value in members.items() if value is not None}
        if matrix is not None:
            item["matrix"] = numpy.asarray(matrix, float).T.ravel().tolist()  # glTF stores columns
        extensions = dict(extensions or {})
        if light is not None:
            extensions["KHR_lights_punctual"] = {"light": light}
        if extensions:
            item["extensions"] = extensions
        index = self._add("nodes", _named(name, **item))
        if root:
            self.document["scenes"][0]["nodes"].append(index)
        return index

    def write(self, path):
        """Writes path, .glb or .gltf (the data inside as base64)."""
        document = dict(self.document)
        used = sorted(_extensions_in(document))
        if used:
            document["extensionsUsed"] = used
        binary = str(path).endswith(".glb")
        if self._data:
            document["buffers"] = [{"byteLength": len(self._data)}]
            if not binary:
                text = base64.b64encode(self._data).decode("ascii")
                document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + text
        text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode("utf-8")
        if not binary:
            with open(path, "wb") as file:
                file.write(text)
            return
        text += b" " * (-len(text) % 4)
        padding = b"\0" * (-len(self._data) % 4)
        size = 12 + 8 + len(text) + (8 + len(self._data) + len(padding) if self._data else 0)
        if size >= 2**32:
            raise ValueError(f"{path}: a .glb holds less than 4 GiB, this scene needs {size} bytes.")
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, size))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            if self._data:
                file.write(struct.pack("<I4s", len(self._data) + len(padding), b"BIN\0"))
                file.write(self._data)
                file.write(padding)


def _named(name, **members):
    return ({"name": name} if name else {}) | members


def _extensions_in(value):
    """The names of the extensions that a document uses."""
    if isinstance(value, dict):
        children = set().union(*map(_extensions_in, value.values())) if value else set()
        return children | set(value.get("extensions", {}))
    if isinstance(value, list):
        return set().union(*map(_extensions_in, value)) if value else set()
    return set()
