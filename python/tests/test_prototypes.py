"""Functions and structures as the package has them, beside the C headers, where these are."""

import ctypes
import pathlib
import re

import pytest

from deldrift import _library

HEADERS = pathlib.Path(__file__).resolve().parents[2] / "include"
NUMBERS = {
    "size_t": ctypes.c_size_t,
    "uint64_t": ctypes.c_uint64,
    "uint32_t": ctypes.c_uint32,
    "int32_t": ctypes.c_int32,
    "uint8_t": ctypes.c_uint8,
    "int": ctypes.c_int,
    "bool": ctypes.c_bool,
    "double": ctypes.c_double,
}


def without_comments(text):
    return re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))


@pytest.fixture(scope="module")
def code():
    paths = sorted(path for path in HEADERS.rglob("*.h") if "mpi" not in path.name)
    if not paths:
        pytest.skip("the headers are not there")
    return without_comments("\n".join(path.read_text(encoding="utf-8") for path in paths))


@pytest.fixture(scope="module")
def numbers(code):
    """Types that are numbers, by name."""
    named = dict(NUMBERS)
    for number, name in re.findall(r"typedef\s+(\w+)\s+(deldrift_\w+)\s*;", code):
        if number in NUMBERS:
            named[name] = NUMBERS[number]
    return named


def is_pointer(declaration):
    return "*" in declaration or "(" in declaration


def kind(number):
    """What a number is passed as: how many bytes, and whether of floating point."""
    return ctypes.sizeof(number), number in (ctypes.c_double, ctypes.c_float)


def is_address(argument):
    return argument in (ctypes.c_void_p, ctypes.c_char_p) or hasattr(argument, "contents")


def test_functions_have_the_arguments_of_the_header(code, numbers):
    declared = dict(re.findall(r"\bdeldrift_status\s+deldrift_(\w+)\(([^;{]*)\)\s*;", code))
    assert len(declared) > 100
    for name, arguments in _library.PROTOTYPES.items():
        parameters = [parameter.strip() for parameter in re.split(r",(?![^(]*\))", declared[name])]
        assert len(parameters) == len(arguments), name
        for parameter, argument in zip(parameters, arguments):
            if is_pointer(parameter):
                assert is_address(argument), (name, parameter)
                pointed = getattr(argument, "_type_", None)
                type_name = parameter.replace("const", "").split("*")[0].strip()
                if isinstance(pointed, type) and type_name in numbers:
                    assert kind(pointed) == kind(numbers[type_name]), (name, parameter)
            else:
                type_name = parameter.split()[-2]
                assert kind(argument) == kind(numbers[type_name]), (name, parameter)


def fields_of(code, name):
    """The fields of a structure of the header: their names and declarations."""
    found = re.search(r"typedef struct %s \{(.*?)\}\s*%s\s*;" % (name, name), code, flags=re.DOTALL)
    assert found, name
    for declaration in found.group(1).split(";"):
        declaration = " ".join(declaration.split())
        if declaration:
            pointer = re.search(r"\(\*(\w+)\)", declaration)
            plain = re.search(r"(\w+)(?:\[(\d+)\])?$", declaration)
            yield (pointer or plain).group(1), declaration, int((plain and plain.group(2)) or 1)


def structures():
    """The structures of the package, by the names that the header has for them."""
    found = {"deldrift_commit_report": _library.Report, "deldrift_quality_report": _library.QualityReport}
    for one in vars(_library).values():
        if isinstance(one, type) and issubclass(one, ctypes.Structure):
            name = re.match(r"deldrift_\w+", one.__doc__ or "")
            if name:
                found[name.group()] = one
    return found


def test_structures_have_the_fields_of_the_header(code, numbers):
    assert len(structures()) == 9
    for name, structure in structures().items():
        wanted = list(fields_of(code, name))
        assert len(wanted) == len(structure._fields_), name
        for (field, declaration, count), (own, own_type, *_) in zip(wanted, structure._fields_):
            assert own.strip("_") == field.strip("_"), (name, field)
            length = getattr(own_type, "_length_", 1)
            number = own_type._type_ if hasattr(own_type, "_length_") else own_type
            assert length == count, (name, field)
            if is_pointer(declaration):
                assert ctypes.sizeof(number) == ctypes.sizeof(ctypes.c_void_p), (name, field)
            else:
                assert kind(number) == kind(numbers[declaration.split()[0]]), (name, field)


def test_statuses_have_the_numbers_of_the_header(code):
    named = {name: int(number) for name, number in re.findall(r"\b(DELDRIFT_\w+)\s*=\s*(\d+)", code)}
    assert named["DELDRIFT_CROSSING"] == _library.FIRST_CONFLICT
    assert named["DELDRIFT_PASSES_SEGMENT"] == _library.PASSES_SEGMENT
    assert named["DELDRIFT_NOT_PREPARED"] == _library.NOT_PREPARED
