"""A bar on stderr for scene.run(progress=True)."""
import sys
import time


def bar():
    """A function of (done, asked) that draws at most ten times a second."""
    last = [0.0]

    def draw(done, asked):
        now = time.monotonic()
        if done < asked and now - last[0] < 0.1:
            return
        last[0] = now
        width = 30
        filled = width * done // max(asked, 1)
        end = "\n" if done >= asked else ""
        sys.stderr.write(f"\r[{'#' * filled}{'.' * (width - filled)}] {done} of {asked} poses{end}")
        sys.stderr.flush()

    return draw
