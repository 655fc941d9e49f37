package deixis.spy;

/** Rows of pixels as they lie in a message; every row is known to be within the data. */
final class Pixels {
  /** More than any camera here delivers; what claims more is refused before memory is taken. */
  static final int MAX_PIXELS = 1 << 24;

  final int width;
  final int height;
  /** Bytes from one row to the next. */
  final int stride;
  final byte[] data;

  private Pixels(int width, int height, int stride, byte[] data) {
    this.width = width;
    this.height = height;
    this.stride = stride;
    this.data = data;
  }

  /** Checks that the numbers of a message fit together. */
  static Pixels checked(int width, int height, int stride, int pixelBytes, byte[] data)
      throws DamagedMessage {
    checkSize(width, height);
    long rowBytes = (long) width * pixelBytes;
    if (stride < rowBytes) {
      throw new DamagedMessage(String.format(
          "row_stride %d is less than %d pixels of %d bytes", stride, width, pixelBytes));
    }
    long needed = (long) (height - 1) * stride + rowBytes;
    if (data.length < needed) {
      throw new DamagedMessage(String.format("%d bytes, but %d x %d at row_stride %d needs %d",
          data.length, width, height, stride, needed));
    }
    return new Pixels(width, height, stride, data);
  }

  /** Refuses a picture without pixels, and one of more than MAX_PIXELS. */
  static void checkSize(int width, int height) throws DamagedMessage {
    if (width <= 0 || height <= 0) {
      throw new DamagedMessage(String.format("size %d x %d is not positive", width, height));
    }
    if ((long) width * height > MAX_PIXELS) {
      throw new DamagedMessage(String.format("size %d x %d is too large", width, height));
    }
  }

  /** The byte at an offset from the begin of a row, 0 to 255. */
  int unsignedByte(int row, int offset) {
    return data[row * stride + offset] & 0xff;
  }

  /** The 16-bit pixel in a column, low byte first, 0 to 65535. */
  int unsignedShort(int row, int column) {
    return unsignedByte(row, 2 * column) | unsignedByte(row, 2 * column + 1) << 8;
  }
}
