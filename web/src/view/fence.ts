// How long a drawing really takes: a fence behind its commands, looked at by a timer, as animation frames
// come too seldom to tell.

const kLook_ms = 3;
// A drawing is waited for so long before the next one is asked for: on a busy machine drawings that are
// asked for before the last one is done pile up, and the page answers no click until all are drawn.
const kLongest_ms = 10_000;

export class Fence {
  private sync_: WebGLSync | null = null;
  private timer_: number | null = null;

  constructor(private readonly gl_: WebGL2RenderingContext) {}

  /** Something is still being drawn. */
  get is_up(): boolean {
    return this.sync_ !== null;
  }

  /** Behind all that was asked for until now; `done` is told how long it took since then, in ms. */
  put(from_ms: number, done: (took_ms: number) => void): void {
    this.sync_ = this.gl_.fenceSync(this.gl_.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl_.flush();
    const look = () => {
      if (!this.sync_) return;
      const took_ms = performance.now() - from_ms;
      const is_done = this.gl_.getSyncParameter(this.sync_, this.gl_.SYNC_STATUS) === this.gl_.SIGNALED;
      if (!is_done && took_ms < kLongest_ms) {
        this.timer_ = window.setTimeout(look, kLook_ms);
        return;
      }
      this.gl_.deleteSync(this.sync_);
      this.sync_ = null;
      done(took_ms);
    };
    this.timer_ = window.setTimeout(look, kLook_ms);
  }

  close(): void {
    if (this.timer_ !== null) clearTimeout(this.timer_);
  }
}
