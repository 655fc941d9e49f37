package deixis.spy;

/** A message that cannot be shown; the text says what is wrong with it. */
final class DamagedMessage extends Exception {
  private static final long serialVersionUID = 1L;

  DamagedMessage(String reason) {
    super(reason);
  }
}
