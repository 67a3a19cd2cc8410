"""Writes the npy files beside it. Run: python3 make.py (NumPy 1.24 wrote those that are kept)."""
import os

import numpy as np

here = os.path.dirname(os.path.abspath(__file__))
points = np.array([[0.0, 0.25], [0.1, -0.5], [1e-300, 3.0]])
integers = np.array([[0, 1], [2, 127], [3, 4]])
signed = np.array([[0, -1], [2, 127], [-128, 4]])


def save(name, array, version=None):
    with open(os.path.join(here, name + ".npy"), "wb") as f:
        np.lib.format.write_array(f, array, version=version, allow_pickle=True)


for dtype in ("<f8", ">f8", "<f4", ">f4"):
    save({"<": "little_", ">": "big_"}[dtype[0]] + dtype[1:], points.astype(dtype))
for dtype in ("<i2", "<i4", "<i8", ">i8", "|i1"):
    save({"<": "little_", ">": "big_", "|": "one_byte_"}[dtype[0]] + dtype[1:], signed.astype(dtype))
for dtype in ("<u2", "<u4", "<u8", ">u2", "|u1"):
    save({"<": "little_", ">": "big_", "|": "one_byte_"}[dtype[0]] + dtype[1:], integers.astype(dtype))
save("fortran", np.asfortranarray(points))
save("version_2", points, (2, 0))
save("version_3", points, (3, 0))
save("columns_3", np.arange(12.0).reshape(4, 3))
save("no_rows", np.zeros((0, 2)))
save("not_finite", np.array([[np.nan, np.inf], [-np.inf, -0.0]]))
save("one_dimension", np.arange(2.0))
save("three_dimensions", np.arange(15.0).reshape(5, 1, 3))
save("scalar", np.array(1.0))
save("limit_i8", np.array([[2**53, -(2**53)]]))
save("beyond_i8", np.array([[0, 0], [0, 2**53 + 1]]))
save("beyond_negative_i8", np.array([[-(2**53) - 1, 0]]))
save("beyond_u8", np.array([[0, 2**64 - 1]], dtype="<u8"))
for dtype in ("f2", "g", "c8", "c16", "?", "U3", "S3", "O", "M8[s]"):
    name = {"?": "bool", "g": "long_double", "M8[s]": "date"}.get(dtype, dtype)
    save("dtype_" + name, np.zeros((1, 2), dtype=dtype))
save("dtype_structured", np.zeros(2, dtype=[("x", "<f8"), ("y", "<f8")]))
