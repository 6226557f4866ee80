// Measures how long the graphics card takes for a drawing, by a GPU fence. A timer polls the fence,
// because animation frames are too rare.

const kLook_ms = 3;
// After this time the fence no longer waits for a drawing. The limit is long: drawings started
// before the last one is done pile up on a busy machine, and block the page until all are done.
const kLongest_ms = 10_000;

export class Fence {
  private sync_: WebGLSync | null = null;
  private timer_: number | null = null;

  constructor(private readonly gl_: WebGL2RenderingContext) {}

  /** True while a drawing is in progress. */
  get is_up(): boolean {
    return this.sync_ !== null;
  }

  /**
   * Sets a fence behind all drawing commands so far. Calls `done` when they are executed, with the
   * time since `from_ms`.
   */
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
