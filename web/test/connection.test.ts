import { beforeEach, describe, expect, it } from 'vitest';
import { backoff_ms, Connection, type Link, type SocketLike } from '../src/server/connection';
import type { Message } from '../src/server/messages';
import { envelope, frame, kStream, snapshot } from './samples';

class FakeSocket implements SocketLike {
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  closed = false;
  constructor(readonly url: string) {}
  close(): void { this.closed = true; }
  say(text: string): void { this.onmessage?.({ data: text }); }
  drop(): void { this.onclose?.(); }
}

let sockets: FakeSocket[];
let pending: { id: number; callback: () => void; delay_ms: number }[];
let links: Link[];
let messages: Message[];
let rejected: string[];
let connection: Connection;

const socket = () => sockets[sockets.length - 1]!;

function fire_timer(): number {
  const timer = pending.shift();
  if (!timer) throw new Error('no timer is set');
  timer.callback();
  return timer.delay_ms;
}

beforeEach(() => {
  sockets = [];
  pending = [];
  links = [];
  messages = [];
  rejected = [];
  let next_id = 1;
  connection = new Connection({
    url: 'ws://cell/ws',
    open_socket: (url) => {
      sockets.push(new FakeSocket(url));
      return socket();
    },
    timers: {
      set: (callback, delay_ms) => {
        pending.push({ id: next_id, callback, delay_ms });
        return next_id++;
      },
      clear: (id) => { pending = pending.filter((timer) => timer.id !== id); },
    },
    on_message: (message) => messages.push(message),
    on_link: (link) => links.push(link),
    on_reject: ({ kind, what }) => rejected.push(`${kind}: ${what}`),
  });
  connection.start();
});

describe('Connection', () => {
  it('is open after the first message', () => {
    expect(links.map((link) => link.status)).toEqual(['connecting']);
    socket().say(snapshot(1));
    expect(links.map((link) => link.status)).toEqual(['connecting', 'open']);
    expect(socket().url).toBe('ws://cell/ws');
  });

  it('resumes after the last event received', () => {
    socket().say(snapshot(40));
    socket().say(envelope('alert', 41, { level: 'info', text: 'x' }));
    socket().say(frame(42, {}));
    socket().drop();
    fire_timer();
    expect(socket().url).toBe(`ws://cell/ws?stream=${kStream}&since=41`);
  });

  it('doubles the retry delay up to five seconds and resets it after a message', () => {
    const delays = Array.from({ length: 7 }, () => {
      socket().drop();
      return fire_timer();
    });
    expect(delays).toEqual([250, 500, 1000, 2000, 4000, 5000, 5000]);
    socket().say(frame(1, {}));
    socket().drop();
    expect(fire_timer()).toBe(250);
    expect(backoff_ms(1000)).toBe(5000);
  });

  it('is open again after a resumed event or a frame', () => {
    socket().say(snapshot(1));
    socket().drop();
    expect(links.at(-1)).toEqual({ status: 'lost', attempt: 1, retry_in_ms: 250 });
    fire_timer();
    expect(links.at(-1)?.status).toBe('lost');
    socket().say(envelope('alert', 2, { level: 'info', text: 'x' }));
    expect(links.at(-1)?.status).toBe('open');
  });

  it('delivers no event twice', () => {
    socket().say(snapshot(5));
    socket().say(envelope('alert', 5, { level: 'info', text: 'old' }));
    socket().say(envelope('alert', 6, { level: 'info', text: 'new' }));
    socket().say(envelope('alert', 6, { level: 'info', text: 'again' }));
    expect(messages.map((message) => message.type)).toEqual(['snapshot', 'alert']);
  });

  it('accepts a snapshot of another session with new numbers', () => {
    socket().say(snapshot(500));
    socket().drop();
    fire_timer();
    socket().say(snapshot(2, {}, { stream: 'other' }));
    socket().say(envelope('alert', 3, { level: 'info', text: 'x' }, { stream: 'other' }));
    expect(messages).toHaveLength(3);
    socket().drop();
    fire_timer();
    expect(socket().url).toContain('stream=other&since=3');
  });

  it('reports unknown and malformed messages and continues', () => {
    socket().say(snapshot(1));
    socket().say('{');
    socket().say(envelope('weather', 2, {}));
    socket().say(envelope('alert', 3, { level: 'info', text: 'x' }));
    expect(rejected).toEqual([expect.stringMatching(/^malformed: not JSON/), 'unknown: weather']);
    expect(messages).toHaveLength(2);
  });

  it('retries at once on request, but not twice', () => {
    socket().drop();
    connection.retry_now();
    expect(sockets).toHaveLength(2);
    expect(pending).toHaveLength(0);
    connection.retry_now();
    expect(sockets).toHaveLength(2);
  });

  it('ignores sockets that it has dropped', () => {
    const first = socket();
    first.say(snapshot(1));
    first.drop();
    fire_timer();
    first.say(envelope('alert', 2, { level: 'info', text: 'late' }));
    first.drop();
    expect(messages).toHaveLength(1);
    expect(pending).toHaveLength(0);
    expect(first.closed).toBe(true);
  });

  it('is silent after stop()', () => {
    const last = socket();
    connection.stop();
    last.drop();
    expect(last.closed).toBe(true);
    expect(pending).toHaveLength(0);
  });
});
