// Reads an MCAP file that this page exported: joint positions and raw events. From any other MCAP
// file it reads only joint states in JSON. Loaded on first use.

import { McapStreamReader, type McapTypes } from '@mcap/core';
import { kMetadata, kTopics, kWallAtZero, wall_ns } from './mcap_layout';
import { kText } from '../strings';
import type { Frames } from './read_states';

export interface Mcap { frames: Frames; /** One line per event, as in events.jsonl. */ events: string }

// Reading pauses this often, so that the page can answer clicks.
const kBreath_ms = 20;
// The magic bytes of an MCAP file.
const kMagic = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];

export async function read_mcap(file: Blob): Promise<{ ok: true; mcap: Mcap } | { ok: false; fault: string }> {
  const names: string[] = [];
  const frames: Frames = { names, t_s: [], q: [] };
  const events: string[] = [];
  const topics = new Map<number, string>();
  const decoder = new TextDecoder();
  let zero_ns: bigint | null = null;
  const take = ({ channelId, logTime, data }: McapTypes.TypedMcapRecords['Message']) => {
    const topic = topics.get(channelId);
    if (topic === kTopics.raw.topic) events.push(decoder.decode(data));
    if (topic !== kTopics.joints.topic) return;
    const places = new Map((JSON.parse(decoder.decode(data)) as JointStates).joints.map(({ name, position }) => [name, position]));
    if (names.length === 0) names.push(...places.keys());
    zero_ns ??= logTime;
    frames.t_s.push(Number(logTime - zero_ns) / 1e9);
    frames.q.push(names.map((name, i) => places.get(name) ?? frames.q.at(-1)?.[i] ?? 0));
  };
  if (file.size === 0) return { ok: false, fault: kText.recordings.empty_file };
  const begin = new Uint8Array(await file.slice(0, kMagic.length).arrayBuffer());
  if (kMagic.some((byte, i) => begin[i] !== byte)) return { ok: false, fault: kText.recordings.not_mcap };
  try {
    const reader = new McapStreamReader();
    reader.append(new Uint8Array(await file.arrayBuffer()));
    let breath_ms = performance.now();
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      if (record.type === 'Channel') topics.set(record.id, record.messageEncoding === 'json' ? record.topic : '');
      if (record.type === 'Metadata' && record.name === kMetadata) zero_ns = wall_ns(Number(record.metadata.get(kWallAtZero)));
      if (record.type === 'Message') take(record);
      if (performance.now() - breath_ms > kBreath_ms) {
        await new Promise((done) => setTimeout(done));
        breath_ms = performance.now();
      }
    }
  } catch (error) {
    return { ok: false, fault: kText.recordings.bad_mcap(String(error)) };
  }
  if (frames.t_s.length === 0) return { ok: false, fault: kText.recordings.no_topic(kTopics.joints.topic) };
  return { ok: true, mcap: { frames, events: events.join('\n') } };
}

interface JointStates { joints: { name: string; position: number }[] }
