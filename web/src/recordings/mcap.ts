// Exports the page's data as an MCAP file with Foxglove's JSON schemas: joint states, link
// transforms, scene, jobs and events. The raw server events are exported too, so that the page can
// replay the file. Loaded on first use.

import { McapWriter, type IWritable } from '@mcap/core';
import * as THREE from 'three';
import type { Cell } from '../server/messages';
import type { Store } from '../state/store';
import { Kinematics } from '../view/kinematics';
import { scene_update } from './foxglove_scene';
import { kSchemas } from './foxglove_schemas';
import { kMetadata, kTopics, kWallAtZero, wall_ns } from './mcap_layout';

const kMostFrames = 9_000;
// Frames written at a time. Between such groups the page can answer clicks.
const kAtOnce = 60;

class Bytes implements IWritable {
  private readonly parts_: Uint8Array[] = [];
  private size_ = 0;

  async write(part: Uint8Array): Promise<void> {
    this.parts_.push(part.slice());
    this.size_ += part.byteLength;
  }
  position(): bigint {
    return BigInt(this.size_);
  }
  all(): Uint8Array<ArrayBuffer> {
    const whole = new Uint8Array(this.size_);
    let at = 0;
    for (const part of this.parts_) {
      whole.set(part, at);
      at += part.byteLength;
    }
    return whole;
  }
}

export async function write_mcap(store: Store, on_progress: (share: number) => void): Promise<Uint8Array<ArrayBuffer>> {
  const bytes = new Bytes();
  const writer = new McapWriter({ writable: bytes });
  await writer.start({ profile: '', library: 'armloom' });
  const zero_s = Date.now() / 1000 - store.t_s;
  await writer.addMetadata({ name: kMetadata, metadata: new Map([[kWallAtZero, String(zero_s)]]) });
  const log = await begin(writer, zero_s);
  const first_s = store.trace.first_s ?? 0;
  await log('scene', first_s, (stamp) => scene_update(store.objects, stamp));
  await write_events(store, first_s, log);
  await write_frames(store, log, on_progress);
  await writer.end();
  return bytes.all();
}

interface Stamp { sec: number; nsec: number }
type Log = (topic: keyof typeof kTopics, t_s: number, message: (stamp: Stamp) => unknown) => Promise<void>;

/**
 * Registers all topics. `offset_s` is the wall-clock time, in seconds, at which cell time is zero.
 */
async function begin(writer: McapWriter, offset_s: number): Promise<Log> {
  const encoder = new TextEncoder();
  const channels = new Map<string, { id: number; sequence: number }>();
  for (const [key, { topic, schema }] of Object.entries(kTopics)) {
    const schemaId = await writer.registerSchema({ name: schema, encoding: 'jsonschema', data: encoder.encode(JSON.stringify(kSchemas[schema])) });
    channels.set(key, { id: await writer.registerChannel({ topic, schemaId, messageEncoding: 'json', metadata: new Map() }), sequence: 0 });
  }
  return async (topic, t_s, message) => {
    const channel = channels.get(topic);
    if (!channel) return;
    const at_s = offset_s + t_s;
    const stamp = { sec: Math.floor(at_s), nsec: Math.floor((at_s % 1) * 1e9) };
    const time = wall_ns(at_s);
    const data = encoder.encode(JSON.stringify(message(stamp)));
    await writer.addMessage({ channelId: channel.id, sequence: channel.sequence++, logTime: time, publishTime: time, data });
  };
}

async function write_events(store: Store, first_s: number, log: Log): Promise<void> {
  for (const event of store.log.entries) await log('raw', event.t_s, () => event);
  const level = { info: 2, warning: 3, error: 4 } as const;
  for (const notice of [...store.notices].reverse()) {
    if (notice.t_s < first_s) continue;
    await log('events', notice.t_s, (timestamp) => ({ timestamp, level: level[notice.level], message: notice.text, name: notice.source, file: '', line: 0 }));
  }
  for (const job of store.all_jobs()) {
    for (const { state, t_s } of store.book.changes(job.id)) {
      if (t_s >= first_s) await log('jobs', t_s, () => ({ id: job.id, name: job.name, arms: job.arms, state }));
    }
  }
}

async function write_frames(store: Store, log: Log, on_progress: (share: number) => void): Promise<void> {
  const names = store.trace.names;
  const { t_s, q } = store.trace.between(names, store.trace.first_s ?? 0, store.trace.last_s ?? 0, kMostFrames);
  const robots = kinematics_of(store.cell);
  for (let i = 0; i < t_s.length; i++) {
    const at_s = t_s[i] ?? 0;
    const now = Object.fromEntries(names.map((name, k) => [name, q[k]?.[i] ?? 0]));
    await log('joints', at_s, (timestamp) => ({ timestamp, joints: names.map((name) => ({ name, position: now[name] })) }));
    await log('transforms', at_s, (timestamp) => ({ transforms: transforms_of(robots, now, timestamp) }));
    if (i % kAtOnce !== 0) continue;
    on_progress(i / t_s.length);
    await new Promise((done) => setTimeout(done));
  }
}

function kinematics_of(cell: Cell | null): Kinematics[] {
  return (cell?.robots ?? []).map((robot) => new Kinematics(robot));
}

/** Returns the pose of every link in the world frame. */
function transforms_of(robots: readonly Kinematics[], q: Readonly<Record<string, number>>, timestamp: Stamp): unknown[] {
  const [place, turn, scale] = [new THREE.Vector3(), new THREE.Quaternion(), new THREE.Vector3()];
  return robots.flatMap((robot) => {
    robot.set_q(q);
    return robot.links().map(([name, link]) => {
      link.matrixWorld.decompose(place, turn, scale);
      return {
        timestamp, parent_frame_id: 'world', child_frame_id: name,
        translation: { x: place.x, y: place.y, z: place.z }, rotation: { x: turn.x, y: turn.y, z: turn.z, w: turn.w },
      };
    });
  });
}
