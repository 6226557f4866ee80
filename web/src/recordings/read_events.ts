// The events of a recording's events.jsonl, as they were told. Pure.

import { parse_message, type SequencedMessage } from '../server/messages';

export interface Events { messages: SequencedMessage[]; unread: number }

// The page goes on to answer clicks meanwhile.
const kAtOnce = 100;

/** Those that cannot be read, of another version of the server, are counted. */
export async function read_events(text: string): Promise<Events> {
  const events: Events = { messages: [], unread: 0 };
  for (const [i, line] of text.split('\n').entries()) {
    if (i % kAtOnce === kAtOnce - 1) await new Promise((done) => setTimeout(done));
    if (line.trim() === '') continue;
    const parsed = parse_message(with_wall_times(line));
    if (parsed.kind === 'message' && parsed.message.type !== 'state') events.messages.push(parsed.message);
    else events.unread += 1;
  }
  return events;
}

/** Simulated runs have no wall time: so that their log repeats. */
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
