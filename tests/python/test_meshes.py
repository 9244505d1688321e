"""Meshes in and arrays out: what is taken, what is refused, and what is copied."""

import pathlib
import pickle
import tracemalloc
import types
import weakref

import hypothesis
import hypothesis.extra.numpy as arrays
import hypothesis.strategies as some
import numpy
import pytest

import stackabilization as st
from conftest import box, program_error


def test_arrays_come_back_as_they_went_in():
    vertices, faces = box((0, 0, 0), (1, 2, 3))
    mesh = st.Mesh(vertices, faces, parts=["side", "rest"], face_parts=[0] * 2 + [1] * 10, unit="mm")
    assert numpy.array_equal(mesh.vertices, vertices) and mesh.vertices.dtype == numpy.float64
    assert numpy.array_equal(mesh.faces, faces) and mesh.faces.dtype == numpy.int32
    assert mesh.parts == ("side", "rest") and mesh.unit == "mm" and list(mesh.face_parts[:3]) == [0, 0, 1]
    assert repr(mesh) == "<Mesh: 8 vertices, 12 faces, 2 parts, mm>"


def test_views_share_the_memory_of_the_mesh_and_outlive_it():
    mesh = st.Mesh(*box((0, 0, 0), (1, 1, 1)))
    first, second = mesh.vertices, mesh.vertices
    assert numpy.shares_memory(first, second) and not first.flags.owndata
    del mesh, second
    assert first[7].tolist() == [1, 1, 1]


def test_nobody_writes_through_a_view():
    mesh = st.Mesh(*box((0, 0, 0), (1, 1, 1)))
    for view in (mesh.vertices, mesh.faces, mesh.face_parts):
        with pytest.raises(ValueError):
            view[0] = 7


def test_a_mesh_is_taken_as_it_is():
    mesh = st.Mesh(*box((0, 0, 0), (1, 1, 1)))
    assert st.Solver(mesh).mesh is mesh


def test_directions_in_c_order_are_not_copied():
    solver = st.Solver(box((0, 0, 0), (1, 1, 1)))
    directions = numpy.tile([0.1, 0.2, 1.0], (100_000, 1))
    tracemalloc.start()
    results = solver.measure_many(directions)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    outputs = 3 * results.f_max.nbytes
    assert peak < outputs + directions.nbytes / 10


@pytest.mark.parametrize("dtype", [numpy.int32, numpy.uint16, numpy.int64, numpy.uint64])
def test_any_whole_numbers_are_faces(dtype):
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    assert numpy.array_equal(st.Mesh(vertices, faces.astype(dtype)).faces, faces)


def test_other_orders_and_precisions_are_converted():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    for other in (numpy.asfortranarray(vertices), vertices.astype(numpy.float32), vertices.tolist(), vertices[::-1][::-1]):
        assert numpy.array_equal(st.Mesh(other, faces).vertices, vertices)


@pytest.mark.parametrize("vertices, faces, words", [
    (numpy.zeros((4, 2)), [[0, 1, 2]], "vertices expects an array of shape (n, 3), found (4, 2)"),
    (numpy.zeros(3), [[0, 1, 2]], "vertices expects an array of shape (n, 3), found (3,)"),
    (numpy.eye(3), [[0, 1, 2, 0]], "faces expects an array of shape (n, 3), found (1, 4)"),
    (numpy.eye(3), [[0.0, 1.0, 2.0]], "faces expects whole numbers, found float64"),
    ([["a", "b", "c"]], [[0, 1, 2]], "vertices expects numbers, found <U1"),
    (numpy.eye(3), [[0, 1, -1]], "row 0 of faces refers to vertex -1"),
    (numpy.eye(3), [[0, 1, 2], [0, 2**32, 2]], "row 1 of faces refers to vertex 4294967296"),
    (numpy.eye(3), numpy.array([[0, 1, 2**63]], numpy.uint64), "row 0 of faces refers to vertex 9223372036854775808"),
    (numpy.ma.masked_less(numpy.eye(3), 0.5), [[0, 1, 2]],
     "vertices expects an array of shape (n, 3) without masked values"),
    ([[0, 0, 0], [1, 0]], [[0, 1, 2]], "vertices expects an array of shape (n, 3)"),
    (numpy.eye(3).astype(object), [[0, 1, 2]], "vertices expects numbers, found object"),
    (numpy.eye(3), [[0, 1, 2], [0, 1, 3]], "triangle 1 refers to vertex 3 of 3"),
    ([[0, 0, 0], [1, 0, 0], [0, numpy.nan, 0]], [[0, 1, 2]],
     "vertex 2 of triangle 0 has a coordinate that is not a finite number"),
    (numpy.eye(3), numpy.zeros((0, 3), int), "the shape has no triangles"),
])
def test_bad_arrays_are_refused_by_row(vertices, faces, words):
    with pytest.raises(st.InputError) as refusal:
        st.Mesh(vertices, faces)
    assert str(refusal.value) == words
    assert isinstance(refusal.value, ValueError)


def test_what_an_object_raises_instead_of_numbers_is_the_cause():
    class Broken:
        def __init__(self, error):
            self.error = error

        def __array__(self, *_):
            raise self.error

    with pytest.raises(st.InputError, match="vertices expects an array") as refusal:
        st.measure((Broken(RuntimeError("no GPU here")), [[0, 1, 2]]))
    assert "no GPU here" in str(refusal.value.__cause__)
    with pytest.raises(KeyboardInterrupt):
        st.measure((Broken(KeyboardInterrupt()), [[0, 1, 2]]))


def test_memory_of_any_layout_gives_the_same_mesh():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    frozen = vertices.copy()
    frozen.setflags(write=False)
    unaligned = numpy.frombuffer(b"-" + vertices.tobytes(), numpy.uint8)[1:].view(numpy.float64).reshape(-1, 3)
    for other in (frozen, unaligned, vertices.astype(">f8"), numpy.asfortranarray(vertices), vertices[::-1][::-1],
                  numpy.repeat(vertices, 2, axis=0)[::2]):
        assert numpy.array_equal(st.Mesh(other, faces).vertices, vertices)
    for other in (numpy.asfortranarray(faces), faces.astype(">i2"), faces[::-1][::-1]):
        assert numpy.array_equal(st.Mesh(vertices, other).faces, faces)


def test_a_mesh_keeps_what_it_was_made_of():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    mesh = st.Mesh(vertices, faces)
    vertices[:], faces[:] = 7, 0
    assert mesh.vertices.max() == 1 and mesh.faces.max() == 7


def test_bad_parts_and_units_are_refused():
    vertices, faces = box((0, 0, 0), (1, 1, 1))
    with pytest.raises(st.InputError, match="one part index per triangle"):
        st.Mesh(vertices, faces, face_parts=[0])
    with pytest.raises(st.InputError, match="triangle 0 belongs to a part that does not exist"):
        st.Mesh(vertices, faces, face_parts=[3] * 12)
    with pytest.raises(st.InputError, match="row 2 of face_parts is 4294967296"):
        st.Mesh(vertices, faces, face_parts=numpy.array([0, 0, 2**32] + [0] * 9))
    with pytest.raises(st.InputError, match="face_parts expects whole numbers, found float64"):
        st.Mesh(vertices, faces, face_parts=[0.5] * 12)
    with pytest.raises(st.InputError, match="parts expects a list of names, found 'seat'"):
        st.Mesh(vertices, faces, parts="seat")
    with pytest.raises(st.InputError, match=r"the part name '\\udcff' is not UTF-8"):
        st.Mesh(vertices, faces, parts=["\udcff"])
    with pytest.raises(st.InputError, match="the part name 'a' occurs twice"):
        st.Mesh(vertices, faces, parts=["a", "a"])
    with pytest.raises(st.UsageError, match="unit expects one of um, mm, cm, m, in, ft, found 'yard'"):
        st.Mesh(vertices, faces, unit="yard")


@hypothesis.given(arrays.arrays(some.sampled_from([numpy.float64, numpy.int8, numpy.bool_, numpy.complex64]),
                                arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4)))
def test_arrays_of_any_shape_are_a_mesh_or_an_input_error(values):
    try:
        mesh = st.Mesh(values, [[0, 1, 2]])
    except st.InputError as refusal:
        assert str(refusal)
    else:
        assert values.ndim == 2 and values.shape[1] == 3 and numpy.array_equal(mesh.vertices, values)


@hypothesis.given(arrays.arrays(numpy.float64, (3, 3), elements=some.floats(allow_nan=True, allow_infinity=True)))
def test_any_numbers_are_measured_or_refused(points):
    try:
        measured = st.measure((points, [[0, 1, 2]]))
    except st.Error as refusal:
        assert str(refusal)
    else:
        assert measured.f_max >= 0 and numpy.isfinite(measured.f_max) and measured.height >= 0


def test_objects_with_arrays_stand_for_a_mesh():
    vertices, faces = box((0, 0, 0), (1, 2, 3))
    flat = numpy.column_stack((numpy.full(len(faces), 3), faces)).ravel()
    expected = st.measure((vertices, faces)).to_dict()
    for stand_in in (
        types.SimpleNamespace(vertices=vertices, faces=faces),  # trimesh
        types.SimpleNamespace(vertices=vertices.tolist(), triangles=faces.tolist()),  # Open3D
        types.SimpleNamespace(points=vertices, faces=flat),  # PyVista
        st.Mesh(vertices, faces),
        [vertices, faces],
    ):
        assert st.measure(stand_in).to_dict() == expected


def test_objects_of_vtk_stand_for_a_mesh():
    sources = pytest.importorskip("vtkmodules.vtkFiltersSources")
    cube = sources.vtkCubeSource()
    cube.Update()
    with pytest.raises(st.InputError, match="face 0 has 4 corners, expected 3: triangulate the mesh first"):
        st.measure(cube.GetOutput())


def test_meshes_of_vtk_are_read_without_a_loop():
    sources = pytest.importorskip("vtkmodules.vtkFiltersSources")
    core = pytest.importorskip("vtkmodules.vtkFiltersCore")
    modelling = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    sphere, triangles = sources.vtkSphereSource(), core.vtkTriangleFilter()
    triangles.SetInputConnection(sphere.GetOutputPort())
    triangles.Update()
    mesh = st.Solver(triangles.GetOutput()).mesh
    assert len(mesh.faces) == triangles.GetOutput().GetNumberOfPolys()
    assert numpy.linalg.norm(mesh.vertices, axis=1) == pytest.approx(0.5)
    strips = core.vtkStripper()
    strips.SetInputConnection(triangles.GetOutputPort())
    strips.Update()
    with pytest.raises(st.InputError, match="triangle strips: triangulate|has no polygons"):
        st.measure(strips.GetOutput())
    with pytest.raises(st.InputError, match="the vtkPolyData has no polygons"):
        st.measure(modelling.vtkPolyData())


def test_meshes_of_open3d_are_read():
    open3d = pytest.importorskip("open3d")
    ball = open3d.geometry.TriangleMesh.create_sphere(radius=2)
    mesh = st.Solver(ball).mesh
    assert numpy.array_equal(mesh.vertices, numpy.asarray(ball.vertices))
    assert st.measure(ball).height == 4


def test_meshes_of_trimesh_are_read():
    trimesh = pytest.importorskip("trimesh")
    assert st.measure(trimesh.creation.box((1, 2, 3))).f_max == 3


def test_meshes_of_pyvista_are_read():
    pyvista = pytest.importorskip("pyvista")
    assert st.measure(pyvista.Cube(z_length=3).triangulate()).f_max == 3


def test_polygons_are_refused_by_row():
    vertices, _ = box((0, 0, 0), (1, 1, 1))
    with pytest.raises(st.InputError, match="face 1 has 4 corners, expected 3"):
        st.measure(types.SimpleNamespace(points=vertices, faces=numpy.array([3, 0, 1, 2, 4, 0, 1, 2, 3])))


def test_what_is_no_mesh_is_refused():
    with pytest.raises(st.InputError, match="found int$"):
        st.measure(7)


def test_paths_are_read_with_their_options(tmp_path):
    mesh = st.Mesh(*box((0, 0, 0), (1, 2, 3)), parts=["cube"], unit="cm")
    mesh.save(tmp_path / "box.obj")
    read = st.load(tmp_path / "box.obj", unit="mm", up="y")
    assert read.unit == "mm" and read.parts == ("cube",)
    assert numpy.ptp(read.vertices, axis=0).tolist() == [1, 3, 2]
    assert st.measure(tmp_path / "box.obj", up="y").height == 2
    assert st.measure(str(tmp_path / "box.obj")).height == 3


def test_files_are_refused_in_the_words_of_the_program(tmp_path):
    broken = tmp_path / "broken.obj"
    broken.write_text("v 0 0 0\nv 1 0 x\nf 1 2 3\n")
    for path in (broken, tmp_path / "missing.obj", tmp_path / "mesh.xyz"):
        with pytest.raises(st.InputError) as refusal:
            st.measure(path)
        assert str(refusal.value) == program_error("measure", path)
        with pytest.raises(st.InputError) as refusal:
            st.load(path)
        assert str(refusal.value) == program_error("measure", path)


@pytest.mark.parametrize("path", ["\udcff.obj", "a\0b.obj"])
def test_paths_that_no_file_can_have_are_refused(path):
    for call in (st.load, st.measure):
        with pytest.raises(st.UsageError, match="path expects a text in UTF-8"):
            call(path)


def test_meshes_go_through_pickle():
    mesh = st.Mesh(*box((0, 0, 0), (1, 1, 1)), parts=["a", "b"], face_parts=[0] * 5 + [1] * 7, unit="mm")
    again = pickle.loads(pickle.dumps(mesh))
    assert numpy.array_equal(again.vertices, mesh.vertices) and numpy.array_equal(again.faces, mesh.faces)
    assert (again.parts, again.unit, again.face_parts.tolist()) == (mesh.parts, mesh.unit, mesh.face_parts.tolist())


def test_a_mesh_in_memory_has_no_file_to_be_read():
    with pytest.raises(st.UsageError, match="say how a file is read, and <mesh> is a mesh in memory"):
        st.measure(box((0, 0, 0), (1, 1, 1)), up="y")
    assert st.measure(box((0, 0, 0), (1, 1, 1)), unit="mm").unit == "mm"


def test_what_cannot_be_written_is_an_output_error(tmp_path):
    mesh = st.Mesh(*box((0, 0, 0), (1, 1, 1)))
    with pytest.raises(st.OutputError) as refusal:
        mesh.save(tmp_path / "no/such/folder/box.obj")
    assert isinstance(refusal.value, OSError)


def test_names_that_begin_with_a_hyphen_are_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    st.Mesh(*box((0, 0, 0), (1, 1, 1))).save(pathlib.Path("--odd.obj"))
    assert st.inspect("--odd.obj").findings.triangles == 12


def test_a_mesh_goes_with_its_last_view():
    mesh = st.Mesh(*box((0, 0, 0), (1, 1, 1)))
    view, alive = mesh.vertices, weakref.ref(mesh)
    del mesh
    assert alive() is not None
    del view
    assert alive() is None
