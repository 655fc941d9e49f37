"""bot_core.pointcloud2_t as a structured numpy array and back. Positions are metres in the frame `frame_id`."""
import numpy as np
from bot_core import pointcloud2_t, pointfield_t

_ELEMENTS = {
    pointfield_t.INT8: "i1", pointfield_t.UINT8: "u1", pointfield_t.INT16: "i2", pointfield_t.UINT16: "u2",
    pointfield_t.INT32: "i4", pointfield_t.UINT32: "u4", pointfield_t.FLOAT32: "f4", pointfield_t.FLOAT64: "f8",
}
_DATATYPES = {np.dtype(element): datatype for datatype, element in _ELEMENTS.items()}


def to_array(cloud):
    """The points as a read-only structured view with the cloud's own fields.

    Shape (width,) where height is 1, else (height, width); a field of count > 1 has that many elements as
    last axis. ValueError if a datatype is not known or the sizes do not fit together.
    """
    dtype = _dtype(cloud)
    rows, columns = cloud.height, cloud.width
    if rows < 0 or columns < 0:
        raise ValueError(f"size {columns} x {rows} is negative")
    if len(cloud.data) != cloud.data_nbytes:
        raise ValueError(f"data have {len(cloud.data)} bytes, data_nbytes says {cloud.data_nbytes}")
    if rows == 0 or columns == 0:
        return np.empty((columns,) if rows == 1 else (rows, columns), dtype)
    if cloud.row_step < columns * cloud.point_step:
        raise ValueError(f"row_step {cloud.row_step} is less than {columns} points of {cloud.point_step} bytes")
    needed = (rows - 1) * cloud.row_step + columns * cloud.point_step
    if len(cloud.data) < needed:
        raise ValueError(f"data have {len(cloud.data)} bytes, {columns} x {rows} points need {needed}")
    points = np.ndarray((rows, columns), dtype, bytes(cloud.data), strides=(cloud.row_step, cloud.point_step))
    return points[0] if rows == 1 else points


def to_xyz(cloud):
    """The positions as a new array (points, 3), metres, invalid ones (NaN) left out. ValueError without x y z."""
    points = to_array(cloud)
    missing = [name for name in "xyz" if name not in points.dtype.names]
    if missing:
        raise ValueError(f"cloud has no field {', '.join(missing)} (it has {', '.join(points.dtype.names)})")
    xyz = np.stack([points[name].ravel() for name in "xyz"], axis=-1)
    return xyz[np.isfinite(xyz).all(axis=1)]


def from_array(points, frame_id, utime, seq=0):
    """pointcloud2_t from a structured array of shape (points,) or (rows, columns).

    `frame_id` names the frame, `utime` is the capture time in microseconds. is_dense is set where all floating
    values are finite. ValueError if the array is not structured or an element type has no counterpart.
    """
    points = np.asarray(points)
    if points.dtype.names is None:
        raise ValueError("points must be a structured array, such as one with dtype [('x', 'f4'), ('y', 'f4'), ...]")
    if points.ndim not in (1, 2):
        raise ValueError(f"shape {points.shape} is neither (points,) nor (rows, columns)")
    little = np.ascontiguousarray(points.astype(points.dtype.newbyteorder("<")))
    cloud = pointcloud2_t()
    cloud.utime, cloud.seq, cloud.frame_id = utime, seq, frame_id
    cloud.height, cloud.width = (1, *points.shape) if points.ndim == 1 else points.shape
    cloud.fields = [_field(name, little.dtype) for name in little.dtype.names]
    cloud.nfields = len(cloud.fields)
    cloud.is_bigendian = False
    cloud.point_step = little.dtype.itemsize
    cloud.row_step = cloud.width * cloud.point_step
    cloud.data = little.tobytes()
    cloud.data_nbytes = len(cloud.data)
    cloud.is_dense = all(np.isfinite(points[name]).all() for name in points.dtype.names)
    return cloud


def _dtype(cloud):
    if cloud.nfields != len(cloud.fields) or not cloud.fields:
        raise ValueError(f"nfields is {cloud.nfields}, but there are {len(cloud.fields)} fields")
    order = ">" if cloud.is_bigendian else "<"
    formats = []
    for field in cloud.fields:
        if field.datatype not in _ELEMENTS:
            raise ValueError(f"field '{field.name}' has datatype {field.datatype}, which is not known")
        if field.count < 1 or field.offset < 0:
            raise ValueError(f"field '{field.name}' has count {field.count} and offset {field.offset}")
        element = np.dtype(order + _ELEMENTS[field.datatype])
        if field.offset + field.count * element.itemsize > cloud.point_step:
            raise ValueError(f"field '{field.name}' ends behind point_step {cloud.point_step}")
        formats.append(element if field.count == 1 else (element, (field.count,)))
    try:
        return np.dtype({"names": [field.name for field in cloud.fields], "formats": formats,
                         "offsets": [field.offset for field in cloud.fields], "itemsize": cloud.point_step})
    except (TypeError, ValueError) as error:
        raise ValueError(f"fields do not make a point: {error}") from None


def _field(name, dtype):
    element, offset = dtype.fields[name][:2]
    base, shape = element.subdtype or (element, ())
    if len(shape) > 1 or base.newbyteorder("=") not in _DATATYPES:
        raise ValueError(f"field '{name}' of type {element} has no counterpart in a point cloud")
    field = pointfield_t()
    field.name, field.offset, field.datatype = name, offset, _DATATYPES[base.newbyteorder("=")]
    field.count = shape[0] if shape else 1
    return field
