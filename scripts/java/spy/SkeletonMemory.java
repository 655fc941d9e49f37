package deixis.spy;

import java.util.ArrayList;
import java.util.Map;
import java.util.TreeMap;
import kinect.skeleton_msg_t;

/** Gathers skeleton messages, one person each, into all people of the last second. */
final class SkeletonMemory {
  private static final long KEEP_US = 1_000_000;

  private final Map<Integer, Figure> people = new TreeMap<>();
  private final Map<Integer, Long> utimes = new TreeMap<>();

  /** All people that are there with this message. */
  Figures with(skeleton_msg_t message) throws DamagedMessage {
    people.put(message.user_id, Figures.of(message));
    utimes.put(message.user_id, message.utime);
    // Times ahead of this one are of a clock that jumped, or of a replay that began anew.
    utimes.values().removeIf(utime -> Math.abs(message.utime - utime) > KEEP_US);
    people.keySet().retainAll(utimes.keySet());
    return new Figures("", new ArrayList<>(people.values()));
  }
}
