package deixis.spy;

import java.io.IOException;
import java.lang.reflect.InvocationTargetException;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.nio.ByteBuffer;
import java.util.Arrays;
import lcm.lcm.LCMDataOutputStream;
import lcm.lcm.LCMEncodable;

/** Runs the public static methods of the named classes, other than main, each as a test. */
public final class Checks {
  private Checks() {}

  /** Something that is expected to fail. */
  interface Step {
    void run() throws Exception;
  }

  /** Exit code 1 when a test fails, or when there is none. */
  public static void main(String[] classNames) throws ClassNotFoundException {
    int passed = 0;
    int failed = 0;
    for (String name : classNames) {
      for (Method method : Class.forName(name).getDeclaredMethods()) {
        if (Modifier.isPublic(method.getModifiers()) && Modifier.isStatic(method.getModifiers())) {
          boolean isPassed = passes(method);
          passed += isPassed ? 1 : 0;
          failed += isPassed ? 0 : 1;
        }
      }
    }
    System.out.println(passed + " passed, " + failed + " failed");
    System.exit(failed == 0 && passed > 0 ? 0 : 1);
  }

  private static boolean passes(Method method) {
    try {
      method.invoke(null);
      return true;
    } catch (InvocationTargetException error) {
      System.out.println("FAILED " + method.getName());
      error.getCause().printStackTrace(System.out);
      return false;
    } catch (IllegalAccessException error) {
      throw new IllegalStateException(error);
    }
  }

  static void equal(Object expected, Object actual) {
    if (!expected.equals(actual)) {
      throw new AssertionError("expected " + expected + ", got " + actual);
    }
  }

  static void isTrue(boolean condition, String what) {
    if (!condition) {
      throw new AssertionError("not so: " + what);
    }
  }

  /** The step must be refused with a reason that holds `part`. */
  static void damaged(String part, Step step) throws Exception {
    try {
      step.run();
    } catch (DamagedMessage error) {
      isTrue(error.getMessage().contains(part), error.getMessage() + " holds " + part);
      return;
    }
    throw new AssertionError("was not refused");
  }

  /** The bytes of a message as they go over the bus. */
  static byte[] encoded(LCMEncodable message) throws IOException {
    LCMDataOutputStream stream = new LCMDataOutputStream();
    message.encode(stream);
    return Arrays.copyOf(stream.getBuffer(), stream.size());
  }

  /** Replaces the 32-bit number `from`, which must be there, by `to`. */
  static byte[] forged(byte[] message, int from, int to) {
    for (int i = 0; i + 4 <= message.length; ++i) {
      if (ByteBuffer.wrap(message).getInt(i) == from) {
        byte[] changed = message.clone();
        ByteBuffer.wrap(changed).putInt(i, to);
        return changed;
      }
    }
    throw new AssertionError("the message does not hold " + from);
  }
}
