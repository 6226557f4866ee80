import { describe, expect, it } from 'vitest';
import { Hand } from '../src/control/hand';
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
  const hand = new Hand({
    control: () => fine<Control>({ holder: server.holder }),
    take_control: (who) => { said.push(`take ${who}`); return fine<ControlTaken>({ holder: holder(who), key: 'k' }); },
    release_control: (key) => { said.push(`release ${key}`); server.holder = null; return fine<Control>({ holder: null }); },
    jog: (arm, state, key) => { said.push(`jog ${arm} ${state} ${key}`); return new Promise((done) => { answer_jog = done; }); },
    renew_jog: (arm) => { said.push(`renew ${arm}`); return server.renews ? fine<Jog>({ job, lease_s: 0.5 }) : refused(server.refusal); },
    cancel_job: (id) => { said.push(`cancel ${id}`); return fine(null); },
  }, { set: (callback) => timers.push(callback), clear: () => undefined }, () => server.has_ended);
  return { hand, said, timers, server, accept: () => answer_jog({ ok: true, value: { job, lease_s: 0.5 } }) };
}

/** Held, and then refused when the server is told of it again. */
async function refuse_held({ hand, timers, server, accept }: ReturnType<typeof bench>, refusal: string): Promise<void> {
  await hand.take('Ada');
  void hand.press('left', 'ready');
  accept();
  await settled();
  server.renews = false;
  server.refusal = refusal;
  timers.shift()?.();
  await settled();
  await settled();
}

describe('moves by hand', () => {
  it('go on only as long as they are renewed, and end at once when the button is let go', async () => {
    const { hand, said, timers, accept } = bench();
    await hand.press('left', 'ready');
    expect(said).toEqual([]);  // without control nothing is asked
    await hand.take('Ada');
    void hand.press('left', 'ready');
    accept();
    await settled();
    timers.shift()?.();
    await settled();
    hand.let_go();
    timers.shift()?.();
    await settled();
    expect(said).toEqual(['take Ada', 'jog left ready k', 'renew left', 'cancel h']);
    expect(timers).toEqual([]);
  });

  it('that are let go before the server has answered are cancelled when it does', async () => {
    const { hand, said, accept } = bench();
    await hand.take('Ada');
    void hand.press('left', 'ready');
    hand.let_go();
    expect(said).not.toContain('cancel h');
    accept();
    await settled();
    expect(said.at(-1)).toBe('cancel h');
    expect(hand.held.value).toBeNull();
  });

  it('end when somebody else takes control, and say so', async () => {
    const held = bench();
    const { hand, server } = held;
    server.holder = holder('Bob');
    await refuse_held(held, 'not-in-control');
    expect([hand.held.value, hand.key.value, hand.refusal.value, hand.holder.value?.who]).toEqual([null, null, 'Bob has control', 'Bob']);
  });

  it('say so when the server was told too late', async () => {
    const held = bench();
    const { hand } = held;
    await refuse_held(held, 'jog-lease-expired');
    expect([hand.held.value, hand.key.value]).toEqual([null, 'k']);
    expect(hand.refusal.value).toMatch(/^The jog motion was stopped.*press it again/);
  });

  it('are asked for no more once the arm is there: nothing is renewed, nothing cancelled', async () => {
    const { hand, said, timers, server, accept } = bench();
    await hand.take('Ada');
    void hand.press('left', 'ready');
    accept();
    await settled();
    server.has_ended = true;
    timers.shift()?.();
    await settled();
    hand.let_go();
    expect(said).toEqual(['take Ada', 'jog left ready k']);
    expect([hand.held.value, hand.refusal.value, timers.length]).toEqual([null, null, 0]);
  });

  it('end when it is told that somebody else has control, before anything is refused', async () => {
    const { hand, said, server, accept } = bench();
    await hand.take('Ada');
    await hand.look();
    expect(hand.key.value).toBe('k');
    void hand.press('left', 'ready');
    accept();
    await settled();
    server.holder = holder('Bob');
    await hand.look();
    expect([hand.held.value, hand.key.value, hand.refusal.value]).toEqual([null, null, 'Bob has control']);
    expect(said).not.toContain('cancel h');
  });

  it('end when control is given back', async () => {
    const { hand, said, accept } = bench();
    await hand.take('Ada');
    void hand.press('left', 'ready');
    accept();
    await settled();
    await hand.give_back();
    expect(said.slice(-2)).toEqual(['cancel h', 'release k']);
    expect(hand.holder.value).toBeNull();
  });
});
