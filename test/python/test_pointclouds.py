"""deixis_lcm.pointclouds: there and back, and one broken cloud per test."""
import numpy as np
import pytest
from bot_core import pointcloud2_t, pointfield_t
from deixis_lcm import pointclouds

XYZ = np.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("label", "u1")])


def points():
    return np.array([(1, 2, 3, 4), (5, 6, 7, 8), (np.nan, 0, 0, 9)], XYZ)


def test_points_go_there_and_back_over_the_wire():
    cloud = pointcloud2_t.decode(pointclouds.from_array(points(), "camera", 11, seq=2).encode())
    assert (cloud.utime, cloud.seq, cloud.frame_id, cloud.height, cloud.width) == (11, 2, "camera", 1, 3)
    assert (cloud.point_step, cloud.row_step, cloud.is_dense) == (13, 39, False)
    assert [field.datatype for field in cloud.fields] == [pointfield_t.FLOAT32] * 3 + [pointfield_t.UINT8]
    assert pointclouds.to_array(cloud).dtype == XYZ
    assert pointclouds.to_array(cloud).tobytes() == points().tobytes()  # bytes, since NaN equals nothing


def test_organised_clouds_keep_their_rows():
    grid = np.resize(points(), 6).reshape(2, 3)
    cloud = pointclouds.to_array(pointclouds.from_array(grid, "camera", 0))
    assert (cloud.shape, cloud.tobytes()) == ((2, 3), grid.tobytes())


def test_fields_may_be_vectors():
    values = np.array([([1, 2, 3],), ([4, 5, 6],)], [("normal", "f8", (3,))])
    cloud = pointclouds.from_array(values, "camera", 0)
    assert (cloud.fields[0].count, cloud.is_dense) == (3, True)
    np.testing.assert_array_equal(pointclouds.to_array(cloud)["normal"], values["normal"])


def test_reads_big_endian_points_and_padded_rows():
    cloud = pointclouds.from_array(points()[:2], "camera", 0)
    cloud.data = points()[:2].astype(XYZ.newbyteorder(">")).tobytes() + b"???"
    cloud.is_bigendian, cloud.row_step, cloud.data_nbytes = True, 29, 29
    np.testing.assert_array_equal(pointclouds.to_array(cloud)["y"], [2, 6])


def test_xyz_leaves_invalid_points_out():
    np.testing.assert_array_equal(pointclouds.to_xyz(pointclouds.from_array(points(), "camera", 0)),
                                  [[1, 2, 3], [5, 6, 7]])


def test_an_empty_cloud_has_no_points():
    assert pointclouds.to_array(pointclouds.from_array(points()[:0], "camera", 0)).shape == (0,)


@pytest.mark.parametrize("field, value, message", [
    ("width", 4, "row_step 39 is less than 4 points"),
    ("width", -1, "negative"),
    ("height", 2, "2 points need|3 x 2 points need"),
    ("data_nbytes", 38, "data_nbytes says 38"),
    ("point_step", 8, "field 'z' ends behind point_step 8"),
    ("nfields", 3, "nfields is 3"),
])
def test_rejects_a_cloud_that_does_not_fit_together(field, value, message):
    cloud = pointclouds.from_array(points(), "camera", 0)
    setattr(cloud, field, value)
    with pytest.raises(ValueError, match=message):
        pointclouds.to_array(cloud)


@pytest.mark.parametrize("field, value, message", [
    ("datatype", 9, "datatype 9"),
    ("offset", -1, "offset -1"),
    ("count", 0, "count 0"),
    ("name", "y", "do not make a point"),
])
def test_rejects_a_broken_field(field, value, message):
    cloud = pointclouds.from_array(points(), "camera", 0)
    setattr(cloud.fields[0], field, value)
    with pytest.raises(ValueError, match=message):
        pointclouds.to_array(cloud)


def test_rejects_arrays_that_are_no_points():
    with pytest.raises(ValueError, match="structured"):
        pointclouds.from_array(np.zeros((3, 3)), "camera", 0)
    with pytest.raises(ValueError, match="neither"):
        pointclouds.from_array(np.zeros((1, 1, 1), XYZ), "camera", 0)
    with pytest.raises(ValueError, match="no counterpart"):
        pointclouds.from_array(np.zeros(2, [("when", "i8")]), "camera", 0)


def test_xyz_needs_x_y_z():
    with pytest.raises(ValueError, match="no field z"):
        pointclouds.to_xyz(pointclouds.from_array(np.zeros(2, [("x", "f4"), ("y", "f4")]), "camera", 0))
