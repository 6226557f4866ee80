// Reads events from before the page was connected, if the server still has them.

import { parse_message, type SequencedMessage } from './messages';
import type { Fetch } from './api';

// Numbers of events to request: about five minutes of eight busy arms. If the server no longer keeps
// so many, it answers with a snapshot, and then fewer are requested.
const kMost = [5000, 1000];
const kPatience_ms = 15_000;

/**
 * Returns the events up to number `until`, as many as the server keeps. Returns none if the server
 * no longer has them or does not answer.
 */
export async function earlier_events(base: string, fetch: Fetch, stream: string, until: number): Promise<SequencedMessage[]> {
  if (until <= 0) return [];
  for (const [i, most] of kMost.entries()) {
    if (i > 0 && until <= most) continue;  // all events were requested already
    const events = await events_since(base, fetch, stream, Math.max(0, until - most), until);
    if (events !== 'forgotten') return events;
  }
  return [];
}

async function events_since(base: string, fetch: Fetch, stream: string, since: number, until: number): Promise<SequencedMessage[] | 'forgotten'> {
  const stop = new AbortController();
  const timer = setTimeout(() => stop.abort(), kPatience_ms);
  const events: SequencedMessage[] = [];
  try {
    const response = await fetch(`${base}/events?stream=${encodeURIComponent(stream)}&since=${since}`, { headers: { accept: 'text/event-stream' }, signal: stop.signal });
    if (!response.ok || !response.body) return [];
    for await (const message of messages_of(response.body.getReader())) {
      // The server sends a snapshot if it no longer has all events since the requested number.
      if (message.type === 'snapshot') return message.stream === stream ? 'forgotten' : [];
      if (message.stream !== stream) return [];
      if (message.seq <= until) events.push(message);
      if (message.seq >= until) break;
    }
  } catch {
    // An incomplete list would have a gap before the page's own events.
    return [];
  } finally {
    clearTimeout(timer);
    stop.abort();
  }
  return events.at(-1)?.seq === until ? events : [];
}

async function* messages_of(reader: ReadableStreamDefaultReader<Uint8Array>): AsyncGenerator<SequencedMessage> {
  const decoder = new TextDecoder();
  let rest = '';
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    const lines = (rest + decoder.decode(part.value, { stream: true })).split('\n');
    rest = lines.pop() ?? '';
    for (const line of lines) {
      if (!line.startsWith('data:')) continue;
      const parsed = parse_message(line.slice(5));
      if (parsed.kind === 'message' && parsed.message.type !== 'state') yield parsed.message;
    }
  }
}
