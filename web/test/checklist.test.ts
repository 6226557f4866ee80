import { describe, expect, it } from 'vitest';
import { Checklist, kChecks } from '../src/recovery/checklist';
import { parse_message } from '../src/server/messages';
import { Store } from '../src/state/store';
import { arm_json, envelope, snapshot } from './samples';

describe('Recovery checklist', () => {
  const store = new Store(() => 0);
  const checklist = new Checklist(store);
  store.on_change(() => checklist.follow());
  const take = (text: string) => {
    const parsed = parse_message(text);
    if (parsed.kind === 'message') store.take(parsed.message);
  };
  const stop = (seq: number, arm: string, state = 'stopped') => {
    take(envelope('alert', seq, { level: 'warning', text: `stopped: ${arm} (operator)` }));
    take(envelope('arm', seq + 1, arm_json(arm, { state })));
  };
  const tick_all = () => kChecks.forEach((_, i) => checklist.tick(i, true));

  it('must be confirmed completely, and again after another stop', () => {
    take(snapshot(1));
    stop(2, 'left');
    expect(checklist.left).toBe(4);
    checklist.tick(0, true);
    checklist.tick(0, false);
    expect(checklist.left).toBe(4);
    tick_all();
    expect(checklist.left).toBe(0);
    stop(4, 'right');
    expect(checklist.left).toBe(4);
  });

  it('keeps its ticks while arms are resumed one by one, and clears them with the last', () => {
    tick_all();
    take(envelope('arm', 6, arm_json('left', { state: 'idle' })));
    expect(checklist.left).toBe(0);
    take(envelope('arm', 7, arm_json('right', { state: 'idle' })));
    expect(checklist.left).toBe(4);
    // Ticks made while no arm is stopped must not count for a later stop.
    tick_all();
    stop(8, 'left');
    expect(checklist.left).toBe(4);
  });
});
