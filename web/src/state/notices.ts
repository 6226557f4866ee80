// The last hundred reports, newest first. They come from the monitor, from the server, or from this
// page.

import type { SequencedMessage } from '../server/messages';
import { monitor_in_words } from '../wording';

export interface Notice {
  key: number;
  /** The server session, or null for reports of this page. */
  stream: string | null;
  seq: number | null;
  t_s: number;
  /** Wall time, if the server sent it. */
  at: string | null;
  level: 'info' | 'warning' | 'error';
  source: 'monitor' | 'alert';
  text: string;
  /** The affected arms, if the server names them. */
  arms: readonly string[];
}

const kMost = 100;

export class Notices {
  private all_: readonly Notice[] = [];
  private next_key_ = 1;

  get all(): readonly Notice[] { return this.all_; }

  /**
   * Returns the reports of a session, and of this page. Times of other sessions cannot be compared
   * with them.
   */
  of_run(stream: string | null): readonly Notice[] {
    return this.all_.filter((notice) => notice.stream === null || notice.stream === stream);
  }

  take(message: SequencedMessage): void {
    const notice = this.of(message);
    if (notice) this.keep(notice);
  }

  /** Adds a report of this page. */
  note(stream: string | null, t_s: number, level: Notice['level'], text: string): void {
    this.keep({ key: this.next_key_++, stream, seq: null, t_s, at: null, level, source: 'alert', text, arms: [] });
  }

  /** Adds reports that are older than the known reports. */
  take_earlier(messages: readonly SequencedMessage[]): void {
    const earlier = messages.flatMap((message) => this.of(message) ?? []).reverse();
    this.all_ = [...this.all_, ...earlier].sort((a, b) => (a.stream === b.stream ? b.t_s - a.t_s : 0)).slice(0, kMost);
  }

  clear(): void {
    this.all_ = [];
  }

  private keep(notice: Notice): void {
    this.all_ = [notice, ...this.all_].slice(0, kMost);
  }

  private of(message: SequencedMessage): Notice | null {
    const common = { stream: message.stream, seq: message.seq, t_s: message.t_s, at: message.at ?? null };
    switch (message.type) {
      case 'monitor': {
        const { data } = message;
        return { ...common, key: this.next_key_++, level: data.stopped.length ? 'error' : 'warning', source: 'monitor', text: monitor_in_words(data), arms: data.arms };
      }
      case 'alert': return { ...common, key: this.next_key_++, level: message.data.level, source: 'alert', text: message.data.text, arms: [] };
      default: return null;
    }
  }
}
