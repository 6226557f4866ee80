// The WebSocket connection. It reconnects when the connection is lost, and resumes the event
// stream.
//
// Socket and timers are injected, so that tests can replace them. Delays between retries double
// from 250 ms to 5 s; a message resets them. When connecting, `stream` and `since` name the last
// event received. The server continues after that event, or sends a new snapshot.

import { parse_message, type Message } from './messages';

/** The members of a browser's WebSocket that are used here. */
export interface SocketLike {
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: (() => void) | null;
  close(): void;
}

export interface Timers {
  set(callback: () => void, delay_ms: number): number;
  clear(id: number): void;
}

export type Link =
  | { status: 'connecting' }
  | { status: 'open' }
  | { status: 'recording'; name: string }  // a recording is shown; the page is not connected
  | { status: 'past' }  // the state of a past time, which sends no requests
  | { status: 'lost'; attempt: number; retry_in_ms: number };

export interface ConnectionOptions {
  url: string;
  open_socket(url: string): SocketLike;
  timers: Timers;
  on_message(message: Message): void;
  on_link(link: Link): void;
  /** Called for messages of unknown type and malformed messages. */
  on_reject(rejected: { kind: 'unknown' | 'malformed'; what: string }): void;
}

const kFirstDelay_ms = 250;
const kMaxDelay_ms = 5000;

export function backoff_ms(attempt: number): number {
  return Math.min(kMaxDelay_ms, kFirstDelay_ms * 2 ** Math.max(0, attempt - 1));
}

export class Connection {
  private socket_: SocketLike | null = null;
  private timer_: number | null = null;
  private attempt_ = 0;
  private stream_: string | null = null;
  private since_ = 0;

  constructor(private readonly options_: ConnectionOptions) {}

  start(): void {
    this.options_.on_link({ status: 'connecting' });
    this.open();
  }

  stop(): void {
    if (this.timer_ !== null) this.options_.timers.clear(this.timer_);
    this.timer_ = null;
    this.release();
  }

  /** Connects again without resuming: the server sends a snapshot. */
  begin_anew(): void {
    this.stop();
    this.stream_ = null;
    this.since_ = 0;
    this.attempt_ = 0;
    this.start();
  }

  /**
   * Retries at once, because the user clicked the button in the banner or the network came back.
   */
  retry_now(): void {
    if (this.timer_ === null) return;
    this.options_.timers.clear(this.timer_);
    this.timer_ = null;
    this.open();
  }

  /** Breaks the connection as a network failure would. The page reconnects later. */
  break(): void {
    if (this.socket_) this.lost();
  }

  private open(): void {
    const { url, open_socket } = this.options_;
    const resume = this.stream_ === null ? '' : `?stream=${encodeURIComponent(this.stream_)}&since=${this.since_}`;
    const socket = open_socket(url + resume);
    this.socket_ = socket;
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => this.lost();
  }

  private receive(data: unknown): void {
    const parsed = parse_message(typeof data === 'string' ? data : '');
    if (this.attempt_ > 0 || parsed.kind === 'message' && parsed.message.type === 'snapshot') {
      this.attempt_ = 0;
      this.options_.on_link({ status: 'open' });
    }
    if (parsed.kind === 'malformed') {
      this.options_.on_reject({ kind: 'malformed', what: parsed.fault });
      return;
    }
    if (parsed.kind === 'unknown') {
      if (parsed.stream !== null && parsed.seq !== null) this.advance(parsed.stream, parsed.seq);
      this.options_.on_reject({ kind: 'unknown', what: parsed.type });
      return;
    }
    const { message } = parsed;
    if (message.type !== 'state') {
      const is_old = message.stream === this.stream_ && message.seq <= this.since_;
      if (is_old && message.type !== 'snapshot') return;
      this.advance(message.stream, message.seq);
    }
    this.options_.on_message(message);
  }

  private advance(stream: string, seq: number): void {
    this.stream_ = stream;
    this.since_ = seq;
  }

  private lost(): void {
    this.release();
    this.attempt_ += 1;
    const retry_in_ms = backoff_ms(this.attempt_);
    this.options_.on_link({ status: 'lost', attempt: this.attempt_, retry_in_ms });
    this.timer_ = this.options_.timers.set(() => {
      this.timer_ = null;
      this.open();
    }, retry_in_ms);
  }

  private release(): void {
    if (!this.socket_) return;
    this.socket_.onmessage = null;
    this.socket_.onclose = null;
    this.socket_.close();
    this.socket_ = null;
  }
}
