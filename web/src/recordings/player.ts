// Shows a recording instead of the live cell. Reads the recording's files into the store. When the
// recording is closed, connects to the server again.

import { signal } from '@preact/signals';
import type { Connection } from '../server/connection';
import type { Router } from '../route/router';
import type { Store } from '../state/store';
import { EventsReader, type Events } from './read_events';
import { StatesReader, type Frames } from './read_states';
import { shown_name } from '../names';
import { kText } from '../strings';
import { of_blob, texts_of, type Source } from './sources';

const kWords = kText.recordings;

/** `frames` is 0 if the recording has no positions. */
export interface Opened { name: string; frames: number; events: number; unread: number; first_s: number; last_s: number }
export interface Reading { name: string; bytes: number; of_bytes: number }
/** The files of a recording that the page reads. Null if a file is missing. */
export interface Sources { states: Source | null; events: Source | null }

type Read = { ok: true; frames: Frames | null; events: Events } | { ok: false; fault: string };

const kShownSteps = 200;

export class Player {
  /** The open recording, or null for the live cell. */
  readonly opened = signal<Opened | null>(null);
  /** The recording being read, or null. */
  readonly reading = signal<Reading | null>(null);
  /** Why the last recording could not be opened, or null. */
  readonly fault = signal<string | null>(null);
  private stop_ = new AbortController();

  constructor(private readonly store_: Store, private readonly connection_: Pick<Connection, 'stop' | 'begin_anew'>, private readonly router_: Router) {}

  /** Opens an MCAP file, or the files of a recording; `folder` is the folder's name if known. */
  open(files: readonly File[], folder: string | null = null): Promise<void> {
    const mcap = files.find(({ name }) => name.endsWith('.mcap'));
    if (mcap) return this.show(mcap.name, mcap.size, (on_bytes, stop) => read_mcap_file(mcap, on_bytes, stop));
    const find = (wanted: string) => files.find(({ name }) => name === wanted);
    const [states, events] = [find('states.csv'), find('events.jsonl')];
    const name = folder ?? (states ?? events)?.name ?? '';
    return this.open_sources(name, { states: states ? of_blob(states) : null, events: events ? of_blob(events) : null });
  }

  open_sources(name: string, sources: Sources): Promise<void> {
    const of_bytes = (sources.states?.bytes ?? 0) + (sources.events?.bytes ?? 0);
    return this.show(name, of_bytes, (on_bytes, stop) => read_sources(name, sources, on_bytes, stop));
  }

  /** Cancels the reading of a recording. */
  stop(): void {
    this.stop_.abort();
    this.reading.value = null;
  }

  /** Returns to the live cell. */
  close(): void {
    this.fault.value = null;
    if (this.opened.value === null) return;
    this.opened.value = null;
    this.router_.show_time(null);
    this.store_.forget_all();
    this.connection_.begin_anew();
  }

  private async show(name: string, of_bytes: number, read: (on_bytes: (bytes: number) => void, stop: AbortSignal) => Promise<Read>): Promise<void> {
    this.stop();
    const stop = this.stop_ = new AbortController();
    this.fault.value = null;
    this.reading.value = { name, bytes: 0, of_bytes };
    let bytes = 0;
    const on_bytes = (more: number) => {
      bytes += more;
      if (!stop.signal.aborted && (bytes - (this.reading.peek()?.bytes ?? 0)) * kShownSteps >= of_bytes) this.reading.value = { name, bytes, of_bytes };
    };
    const got = await read(on_bytes, stop.signal).catch((error: unknown): Read => ({ ok: false, fault: kWords.incomplete(String(error)) }));
    if (stop.signal.aborted) return;  // the user canceled the reading
    this.reading.value = null;
    const fault = got.ok ? this.look_at(name, got.frames, got.events) : got.fault;
    this.fault.value = fault === null || name === '' || fault.includes(shown_name(name)) ? fault : `${shown_name(name)}: ${fault}`;
  }

  /** Shows the recording and returns null, or returns why it cannot be shown. */
  private look_at(name: string, frames: Frames | null, { messages, unread }: Events): string | null {
    const strange = this.strange_in(frames, messages);
    if (strange !== null) return kWords.other_cell(strange);
    const times = frames?.t_s ?? messages.map(({ t_s }) => t_s);
    const [first_s, last_s] = [times[0], times.at(-1)];
    if (first_s === undefined || last_s === undefined) return kWords.nothing_in_it;
    this.connection_.stop();
    this.store_.show_recording(name, messages, frames);
    this.opened.value = { name, frames: frames?.t_s.length ?? 0, events: messages.length, unread, first_s, last_s };
    this.router_.show_time(first_s);
    return null;
  }

  private strange_in(frames: Frames | null, messages: Events['messages']): string | null {
    const { cell, arms } = this.store_;
    const joints = new Set(cell?.joints.map(({ name }) => name));
    const joint = frames?.names.find((name) => !joints.has(name));
    if (joint !== undefined) return kWords.joint(joint);
    const arm = messages.flatMap((message) => (message.type === 'arm' ? [message.data.name] : [])).find((name) => !arms.has(name));
    return arm === undefined || arms.size === 0 ? null : kWords.arm(arm);
  }
}

async function read_sources(name: string, { states, events }: Sources, on_bytes: (bytes: number) => void, stop: AbortSignal): Promise<Read> {
  if (!states && !events) return { ok: false, fault: kWords.not_a_recording(name === '' ? kWords.among_files : kWords.in_folder(shown_name(name))) };
  const events_reader = new EventsReader();
  if (events) for await (const text of texts_of(events, stop, on_bytes)) events_reader.take(text);
  if (!states) return { ok: true, frames: null, events: events_reader.end() };
  const states_reader = new StatesReader();
  for await (const text of texts_of(states, stop, on_bytes)) {
    states_reader.take(text);
    if (states_reader.is_faulty) break;
  }
  const read = states_reader.end();
  return read.ok ? { ok: true, frames: read.frames, events: events_reader.end() } : read;
}

async function read_mcap_file(file: File, on_bytes: (bytes: number) => void, stop: AbortSignal): Promise<Read> {
  const { read_mcap } = await import('./read_mcap');
  const read = await read_mcap(file);
  if (!read.ok) return read;
  on_bytes(file.size);
  const reader = new EventsReader();
  for await (const text of texts_of(of_blob(new Blob([read.mcap.events])), stop, () => undefined)) reader.take(text);
  return { ok: true, frames: read.mcap.frames, events: reader.end() };
}
