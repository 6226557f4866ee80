import { describe, expect, it } from 'vitest';
import { percent_text } from '../src/arms/speed_slider';
import { SpeedOverride } from '../src/state/speed_override';

class Desk {
  readonly sent: [string | null, number][] = [];
  private readonly answers_: ((accepted: boolean) => void)[] = [];
  private readonly late_: (() => void)[] = [];
  readonly speed = new SpeedOverride((target, share) => {
    this.sent.push([target, share]);
    return new Promise((answer) => this.answers_.push(answer));
  }, { set: (callback) => this.late_.push(callback), clear: () => undefined });

  async answer(accepted = true): Promise<void> {
    this.answers_.shift()?.(accepted);
    await new Promise((done) => { setTimeout(done, 0); });
  }
  time_passes(): void {
    for (const callback of this.late_.splice(0)) callback();
  }
}

describe('SpeedOverride', () => {
  it('sends one request at a time, and then the newest value', async () => {
    const desk = new Desk();
    for (const share of [0.9, 0.8, 0.7]) desk.speed.set(null, share);
    desk.speed.set('left', 0.5);
    expect(desk.sent).toEqual([[null, 0.9], ['left', 0.5]]);
    await desk.answer();
    expect(desk.sent.at(-1)).toEqual([null, 0.7]);
    expect(desk.speed.shown(null, 0.9)).toBe(0.7);
  });

  it('shows what another client sets once its own value is confirmed', async () => {
    const desk = new Desk();
    desk.speed.set('left', 0.4);
    await desk.answer();
    expect(desk.speed.shown('left', 1)).toBe(0.4);
    desk.speed.confirm('left', 1);
    expect(desk.speed.shown('left', 1)).toBe(0.4);
    desk.speed.confirm('left', 0.4);
    expect(desk.speed.shown('left', 0.2)).toBe(0.2);
  });

  it('shows the value of the server if no event confirms its own value in time', async () => {
    const desk = new Desk();
    desk.speed.set(null, 0.4);
    await desk.answer();
    desk.time_passes();
    expect(desk.speed.shown(null, 0.3)).toBe(0.3);
  });

  it('shows the value of the server after a refusal', async () => {
    const desk = new Desk();
    desk.speed.set(null, 0.4);
    await desk.answer(false);
    expect(desk.speed.shown(null, 1)).toBe(1);
    expect(desk.sent).toHaveLength(1);
  });
});

describe('percent_text', () => {
  it.each([[1, '100 %'], [0.25, '25 %'], [0.001, '0.1 %'], [0, '0 %']])('writes %s as %s', (share, text) => {
    expect(percent_text(share)).toBe(text);
  });
});
