// Reads the events of a recording's events.jsonl. Pure.

import { parse_message, type SequencedMessage } from '../server/messages';

export interface Events { messages: SequencedMessage[]; unread: number }

export class EventsReader {
  private rest_ = '';
  private readonly events_: Events = { messages: [], unread: 0 };

  /** Takes the next part of the file. Parts may be split anywhere. */
  take(text: string): void {
    const lines = (this.rest_ + text).split('\n');
    this.rest_ = lines.pop() ?? '';
    for (const line of lines) this.line(line);
  }

  /**
   * Returns the events, and the number of unreadable lines. A line is unreadable if another server
   * version wrote it or if it was cut at the end.
   */
  end(): Events {
    this.line(this.rest_);
    this.rest_ = '';
    return this.events_;
  }

  private line(line: string): void {
    if (line.trim() === '') return;
    const parsed = parse_message(with_wall_times(line));
    if (parsed.kind === 'message' && parsed.message.type !== 'state') this.events_.messages.push(parsed.message);
    else this.events_.unread += 1;
  }
}

/**
 * Returns the line with empty wall times if it has none. Simulated runs have no wall times, so that
 * their logs are reproducible.
 */
function with_wall_times(line: string): string {
  if (line.includes('"at":')) return line;
  try {
    const event = JSON.parse(line) as { at?: string; data?: Record<string, unknown> };
    event.at = '';
    const { data } = event;
    if (data && 'submitted_s' in data) {
      data['submitted_at'] = '';
      for (const when of ['scheduled_at', 'started_at', 'ended_at']) data[when] = null;
    }
    return JSON.stringify(event);
  } catch {
    return line;
  }
}
