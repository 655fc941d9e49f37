package deixis.spy;

import java.awt.AWTError;
import java.awt.GraphicsEnvironment;
import lcm.spy.Spy;

/**
 * Starts lcm-spy where a window can be opened; else says in one line why not, exit code 1. The
 * property deixis.spy.scanned names the jars that lcm-spy searches for types and windows: a search
 * of all jars takes long and complains of classes in them that are made for other systems.
 */
public final class Main {
  private static final String SCANNED = "deixis.spy.scanned";
  private static final String CLASS_PATH = System.getProperty("java.class.path");
  private static final String CURE_JAVA = "this Java opens no windows (a headless runtime): run"
      + " scripts/setup --spy, or install the package default-jre";

  private Main() {}

  /** Hands its arguments on to lcm-spy. */
  public static void main(String[] arguments) {
    String reason = whyNoWindow();
    if (reason != null) {
      System.err.println("deixis: " + reason);
      System.exit(1);
    }
    System.setProperty("java.class.path", System.getProperty(SCANNED, CLASS_PATH));
    Spy.main(arguments);
  }

  private static String whyNoWindow() {
    try {
      if (GraphicsEnvironment.isHeadless()) {
        return CURE_JAVA;
      }
      GraphicsEnvironment.getLocalGraphicsEnvironment().getDefaultScreenDevice();
      return null;
    } catch (AWTError | NoClassDefFoundError error) {
      return "no window can be opened on the display " + System.getenv("DISPLAY")
          + ": set DISPLAY to one that you may use";
    } catch (UnsatisfiedLinkError error) {
      return CURE_JAVA;
    }
  }
}
