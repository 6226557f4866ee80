// Reads joint positions from a recording's states.csv, and thins them. The file has one row per
// control tick; the view needs 30 rows per second. Pure.

import { cut_text } from '../names';
import { kText } from '../strings';

const kWords = kText.recordings;

export interface Frames { names: string[]; t_s: number[]; q: number[][] }

const kStep_s = 1 / 30;
// Largest number of rows kept. A longer recording is thinned further.
const kMost = 60_000;
const kLongestLine = 1 << 20;

export class StatesReader {
  private names_: string[] | null = null;
  private rest_ = '';
  private row_ = 1;
  private step_s_ = kStep_s;
  private t_s_: number[] = [];
  private q_: number[][] = [];
  private fault_: string | null = null;

  /** Takes the next part of the file. Parts may be split anywhere. */
  take(text: string): void {
    if (this.fault_ !== null) return;
    const lines = (this.rest_ + text).split('\n');
    this.rest_ = lines.pop() ?? '';
    for (const line of lines) this.line(line);
    if (this.rest_.length > kLongestLine) this.fault_ = kWords.long_line(this.row_);
  }

  /** Returns true if a fault was found, so that the rest of the file need not be read. */
  get is_faulty(): boolean {
    return this.fault_ !== null;
  }

  /**
   * Returns the frames. A last row without a newline is dropped, because the recording was cut off
   * there.
   */
  end(): { ok: true; frames: Frames } | { ok: false; fault: string } {
    if (this.fault_ !== null) return { ok: false, fault: this.fault_ };
    if (!this.names_ || this.t_s_.length === 0) return { ok: false, fault: kWords.no_positions };
    return { ok: true, frames: { names: this.names_, t_s: this.t_s_, q: this.q_ } };
  }

  private line(line: string): void {
    const row = this.row_++;
    if (this.fault_ !== null || line.trim() === '') return;
    if (!this.names_) {
      const [time, ...names] = line.trim().split(',');
      if (time === 'time_s' && names.length > 0) this.names_ = names;
      else this.fault_ = kWords.bad_header(cut_text(line, 30));
      return;
    }
    const comma = line.indexOf(',');
    const t_s = Number(line.slice(0, comma));
    const last_s = this.t_s_.at(-1);
    if (last_s !== undefined && t_s - last_s < this.step_s_ - 1e-9) return;
    const q = line.slice(comma + 1).split(',').map(Number);
    if (comma < 0 || !Number.isFinite(t_s) || q.length !== this.names_.length || !q.every(Number.isFinite)) {
      this.fault_ = kWords.bad_row(row, this.names_.length, cut_text(line, 40));
      return;
    }
    this.t_s_.push(t_s);
    this.q_.push(q);
    if (this.t_s_.length >= kMost) this.thin();
  }

  private thin(): void {
    this.step_s_ *= 2;
    const every_second = (_: unknown, i: number) => i % 2 === 0;
    this.t_s_ = this.t_s_.filter(every_second);
    this.q_ = this.q_.filter(every_second);
  }
}
