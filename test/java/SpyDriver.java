package deixis.spy;

import java.awt.Component;
import java.awt.Container;
import java.awt.Frame;
import java.awt.Point;
import java.awt.Rectangle;
import java.awt.Robot;
import java.awt.Toolkit;
import java.awt.event.InputEvent;
import java.awt.event.WindowEvent;
import java.io.BufferedReader;
import java.io.File;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;
import javax.imageio.ImageIO;
import javax.swing.AbstractButton;
import javax.swing.JTable;
import javax.swing.MenuElement;
import javax.swing.MenuSelectionManager;
import javax.swing.SwingUtilities;

/**
 * Runs lcm-spy as scripts/deixis spy does, and the mouse as a person would. Commands on stdin, a
 * line each; each is answered by a line "answer ...":
 *
 * <pre>
 * row CHANNEL            what stands in its row, or "none" while there is none
 * open CHANNEL X Y W H   double click; the window that it opens is put there
 * menu CHANNEL           right click: what the menu offers
 * shot FILE              the whole screen as a PNG file
 * close CHANNEL          closes the window as its frame's button does
 * feeds CHANNEL          how many windows are being fed from it
 * </pre>
 */
public final class SpyDriver {
  private static final long PATIENCE_NS = 5_000_000_000L;

  private static final int MOST_TRIES = 5;

  private final Robot robot;

  private SpyDriver() throws Exception {
    robot = new Robot();
    // No waiting for idleness: while messages come, the windows are never idle.
    robot.setAutoDelay(30);
  }

  /** Ends with the last command. */
  public static void main(String[] arguments) throws Exception {
    Main.main(arguments);
    SpyDriver driver = new SpyDriver();
    BufferedReader commands =
        new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
    for (String line = commands.readLine(); line != null; line = commands.readLine()) {
      System.out.println("answer " + driver.answer(line.split(" ")));
    }
    System.exit(0);
  }

  private String answer(String[] words) throws Exception {
    switch (words[0]) {
      case "row":
        return rowText(words[1]);
      case "open":
        return open(words);
      case "menu":
        return menu(words[1]);
      case "shot":
        Rectangle screen = new Rectangle(Toolkit.getDefaultToolkit().getScreenSize());
        ImageIO.write(robot.createScreenCapture(screen), "png", new File(words[1]));
        return "done";
      case "feeds":
        return String.valueOf(Thread.getAllStackTraces().keySet().stream()
            .filter(thread -> thread.getName().equals("deixis " + words[1])).count());
      default:
        return close(words[1]);
    }
  }

  private String rowText(String channel) throws Exception {
    int row = row(channel);
    List<String> cells = new ArrayList<>();
    SwingUtilities.invokeAndWait(() -> {
      for (int column = 0; row >= 0 && column < table().getColumnCount(); ++column) {
        cells.add(String.valueOf(table().getValueAt(row, column)).trim());
      }
    });
    return row < 0 ? "none" : String.join("|", cells);
  }

  private String open(String[] words) throws Exception {
    Frame frame = null;
    for (int tries = 0; tries < MOST_TRIES && frame == null; ++tries) {
      // A row that moves between the two clicks, since a channel came in above it, makes none.
      click(words[1], InputEvent.BUTTON1_DOWN_MASK, 2);
      frame = awaitFrame(words[1]);
    }
    return place(frame, words);
  }

  private static String place(Frame frame, String[] words) throws Exception {
    if (frame == null) {
      return "no window";
    }
    SwingUtilities.invokeAndWait(() -> {
      frame.setBounds(Integer.parseInt(words[2]), Integer.parseInt(words[3]),
          Integer.parseInt(words[4]), Integer.parseInt(words[5]));
      frame.validate();
    });
    return "done";
  }

  private String menu(String channel) throws Exception {
    click(channel, InputEvent.BUTTON3_DOWN_MASK, 1);
    List<String> entries = new ArrayList<>();
    SwingUtilities.invokeAndWait(() -> {
      for (MenuElement menu : MenuSelectionManager.defaultManager().getSelectedPath()) {
        for (MenuElement entry : menu.getSubElements()) {
          entries.add(((AbstractButton) entry).getText());
        }
      }
      MenuSelectionManager.defaultManager().clearSelectedPath();
    });
    return String.join("|", entries);
  }

  private String close(String channel) throws Exception {
    Frame frame = awaitFrame(channel);
    if (frame == null) {
      return "no window";
    }
    SwingUtilities.invokeAndWait(() -> frame.dispatchEvent(
        new WindowEvent(frame, WindowEvent.WINDOW_CLOSING)));
    return "done";
  }

  private void click(String channel, int button, int times) throws Exception {
    int row = row(channel);
    Point[] place = new Point[1];
    SwingUtilities.invokeAndWait(() -> {
      Rectangle cell = table().getCellRect(row, 0, true);
      place[0] = new Point(cell.x + 20, cell.y + cell.height / 2);
      SwingUtilities.convertPointToScreen(place[0], table());
    });
    robot.mouseMove(place[0].x, place[0].y);
    for (int i = 0; i < times; ++i) {
      robot.mousePress(button);
      robot.mouseRelease(button);
    }
  }

  private static int row(String channel) throws Exception {
    int[] found = {-1};
    SwingUtilities.invokeAndWait(() -> {
      for (int row = 0; row < table().getRowCount(); ++row) {
        if (channel.equals(table().getValueAt(row, 0))) {
          found[0] = row;
        }
      }
    });
    return found[0];
  }

  /** The channel's window; null when there is none for a while. */
  private static Frame awaitFrame(String title) throws Exception {
    long deadline = System.nanoTime() + PATIENCE_NS;
    while (System.nanoTime() < deadline) {
      for (Frame frame : Frame.getFrames()) {
        if (title.equals(frame.getTitle()) && frame.isShowing()) {
          return frame;
        }
      }
      Thread.sleep(20);
    }
    return null;
  }

  private static JTable table() {
    for (Frame frame : Frame.getFrames()) {
      JTable table = frame.getTitle().startsWith("LCM Spy") ? tableIn(frame) : null;
      if (table != null) {
        return table;
      }
    }
    throw new IllegalStateException("lcm-spy has no table");
  }

  private static JTable tableIn(Container container) {
    for (Component child : container.getComponents()) {
      JTable table = child instanceof JTable ? (JTable) child
          : child instanceof Container ? tableIn((Container) child) : null;
      if (table != null) {
        return table;
      }
    }
    return null;
  }
}
