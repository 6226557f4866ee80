import { describe, expect, it } from 'vitest';
import { JogControl } from '../src/control/jog_control';
import type { Answer } from '../src/server/api';
import type { Control, ControlTaken, Jog, Job } from '../src/server/messages';
import { job_json } from './samples';

const holder = (who: string) => ({ who, since_at: '2026-11-23T15:00:00Z', arm: null, job: null });
const fine = <T>(value: T): Promise<Answer<T>> => Promise.resolve({ ok: true, value });
const refused = (type: string): Promise<Answer<never>> =>
  Promise.resolve({ ok: false, problem: { type: `urn:armloom:problem:${type}`, title: 'Refused', status: 409, detail: 'Bob has control' } });
const job = job_json('h') as unknown as Job;
const settled = () => new Promise((done) => setTimeout(done, 0));

function bench() {
  const said: string[] = [];
  const timers: (() => void)[] = [];
  const server = { refusal: 'not-in-control', renews: true, has_ended: false, holder: holder('Ada') as Control['holder'] };
  let answer_jog: (answer: Answer<Jog>) => void = () => undefined;
  const jogging = new JogControl({
    control: () => fine<Control>({ holder: server.holder }),
    take_control: (who) => { said.push(`take ${who}`); return fine<ControlTaken>({ holder: holder(who), key: 'k' }); },
    release_control: (key) => { said.push(`release ${key}`); server.holder = null; return fine<Control>({ holder: null }); },
    jog: (arm, state, key) => { said.push(`jog ${arm} ${state} ${key}`); return new Promise((done) => { answer_jog = done; }); },
    renew_jog: (arm) => { said.push(`renew ${arm}`); return server.renews ? fine<Jog>({ job, lease_s: 0.5 }) : refused(server.refusal); },
    cancel_job: (id) => { said.push(`cancel ${id}`); return fine(null); },
  }, { set: (callback) => timers.push(callback), clear: () => undefined }, () => server.has_ended);
  return { jogging, said, timers, server, accept: () => answer_jog({ ok: true, value: { job, lease_s: 0.5 } }) };
}

/** Presses the button. The server then refuses the renewal. */
async function refuse_held({ jogging, timers, server, accept }: ReturnType<typeof bench>, refusal: string): Promise<void> {
  await jogging.take('Ada');
  void jogging.press('left', 'ready');
  accept();
  await settled();
  server.renews = false;
  server.refusal = refusal;
  timers.shift()?.();
  await settled();
  await settled();
}

describe('Jogging', () => {
  it('continues only while renewed, and ends at once on release', async () => {
    const { jogging, said, timers, accept } = bench();
    await jogging.press('left', 'ready');
    expect(said).toEqual([]);  // the page sends no request without control
    await jogging.take('Ada');
    void jogging.press('left', 'ready');
    accept();
    await settled();
    for (let i = 0; i < 2; i++) {
      timers.shift()?.();
      await settled();
    }
    jogging.release();
    timers.shift()?.();
    await settled();
    expect(said).toEqual(['take Ada', 'jog left ready k', 'renew left', 'renew left', 'cancel h']);
    expect(timers).toEqual([]);
  });

  it('is canceled if released before the server answers', async () => {
    const { jogging, said, accept } = bench();
    await jogging.take('Ada');
    void jogging.press('left', 'ready');
    jogging.release();
    expect(said).not.toContain('cancel h');
    accept();
    await settled();
    expect(said.at(-1)).toBe('cancel h');
    expect(jogging.pressed.value).toBeNull();
  });

  it('ends when somebody else takes control, and says so', async () => {
    const pressed = bench();
    const { jogging, server } = pressed;
    server.holder = holder('Bob');
    await refuse_held(pressed, 'not-in-control');
    expect([jogging.pressed.value, jogging.key.value, jogging.refusal.value, jogging.holder.value?.who]).toEqual([null, null, 'Bob has control', 'Bob']);
  });

  it('says that the renewal came too late', async () => {
    const pressed = bench();
    const { jogging } = pressed;
    await refuse_held(pressed, 'jog-lease-expired');
    expect([jogging.pressed.value, jogging.key.value]).toEqual([null, 'k']);
    expect(jogging.refusal.value).toMatch(/^The jog motion was stopped.*press it again/);
  });

  it('stops renewing at the goal, without a cancel', async () => {
    const { jogging, said, timers, server, accept } = bench();
    await jogging.take('Ada');
    void jogging.press('left', 'ready');
    accept();
    await settled();
    server.has_ended = true;
    timers.shift()?.();
    await settled();
    jogging.release();
    expect(said).toEqual(['take Ada', 'jog left ready k']);
    expect([jogging.pressed.value, jogging.refusal.value, timers.length]).toEqual([null, null, 0]);
  });

  it('ends when the page learns that somebody else has control', async () => {
    const { jogging, said, server, accept } = bench();
    await jogging.take('Ada');
    await jogging.look();
    expect(jogging.key.value).toBe('k');
    void jogging.press('left', 'ready');
    accept();
    await settled();
    server.holder = holder('Bob');
    await jogging.look();
    expect([jogging.pressed.value, jogging.key.value, jogging.refusal.value]).toEqual([null, null, 'Bob has control']);
    expect(said).not.toContain('cancel h');
  });

  it('ends when control is released', async () => {
    const { jogging, said, accept } = bench();
    await jogging.take('Ada');
    void jogging.press('left', 'ready');
    accept();
    await settled();
    await jogging.release_control();
    expect(said.slice(-2)).toEqual(['cancel h', 'release k']);
    expect(jogging.holder.value).toBeNull();
  });
});
