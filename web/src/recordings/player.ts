// A recording that is looked at instead of the server's present: its files are read into the store, and
// the page is led back to the present when it is closed.

import { signal } from '@preact/signals';
import type { Connection } from '../server/connection';
import type { Router } from '../route/router';
import type { Store } from '../state/store';
import { read_events } from './read_events';
import { StatesReader, type Frames } from './read_states';

export interface Opened { name: string; frames: number; events: number; unread: number; first_s: number; last_s: number }
type Opening = { ok: true; opened: Opened } | { ok: false; fault: string };

export class Player {
  /** What is looked at; null: the present. */
  readonly opened = signal<Opened | null>(null);
  readonly reading = signal(false);
  /** Why the last files are none that can be looked at. */
  readonly fault = signal<string | null>(null);

  constructor(private readonly store_: Store, private readonly connection_: Pick<Connection, 'stop' | 'begin_anew'>, private readonly router_: Router) {}

  /** The files of a recording's folder, of which others are not needed; or an MCAP file. */
  async open(files: readonly File[]): Promise<void> {
    this.reading.value = true;
    const opening = await this.read(files);
    this.reading.value = false;
    this.fault.value = opening.ok ? null : opening.fault;
  }

  /** Back to the present. */
  close(): void {
    this.fault.value = null;
    if (this.opened.value === null) return;
    this.opened.value = null;
    this.router_.hold_at(null);
    this.store_.forget_all();
    this.connection_.begin_anew();
  }

  private async read(files: readonly File[]): Promise<Opening> {
    const recording = await recording_of(files);
    if (!recording.ok) return recording;
    const { name, frames } = recording;
    const joints = new Set(this.store_.cell?.joints.map(({ name }) => name));
    const strange = frames.names.find((name) => !joints.has(name));
    if (strange !== undefined) return { ok: false, fault: `It was recorded with another cell: this server's has no joint ${strange}.` };
    const events = await read_events(recording.events);
    this.connection_.stop();
    this.store_.show_recording(name, events.messages, frames);
    const [first_s = 0, last_s = 0] = [frames.t_s[0], frames.t_s.at(-1)];
    const opened = { name, frames: frames.t_s.length, events: events.messages.length, unread: events.unread, first_s, last_s };
    this.opened.value = opened;
    this.router_.hold_at(first_s);
    return { ok: true, opened };
  }
}

type Recording = { ok: true; name: string; frames: Frames; events: string } | { ok: false; fault: string };

async function recording_of(files: readonly File[]): Promise<Recording> {
  const mcap = files.find(({ name }) => name.endsWith('.mcap'));
  if (mcap) {
    const { read_mcap } = await import('./read_mcap');
    const read = await read_mcap(mcap);
    return read.ok ? { ok: true, name: mcap.name, ...read.mcap } : read;
  }
  const find = (name: string) => files.find((file) => file.name === name);
  const states = find('states.csv');
  if (!states) return { ok: false, fault: 'There is no states.csv among the files, and no MCAP file: these have the arms\' positions. A server writes states.csv with --data DIR --record, simulate always.' };
  const read = await read_states(states);
  const name = states.webkitRelativePath.split('/').at(-2) ?? states.name;
  return read.ok ? { ok: true, name, frames: read.frames, events: await find('events.jsonl')?.text() ?? '' } : read;
}

async function read_states(file: File) {
  const reader = new StatesReader();
  const decoder = new TextDecoder();
  const stream = file.stream().getReader();
  for (let part = await stream.read(); !part.done; part = await stream.read()) reader.take(decoder.decode(part.value, { stream: true }));
  reader.take(decoder.decode());
  return reader.end();
}
