// An arm by hand: buttons that move it to its named states as long as they are held.

import { useEffect } from 'preact/hooks';
import { arm_of, states_of } from '../compose/goal';
import { InSight } from '../frame/in_sight';
import type { Arm } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { reason_in_words } from '../wording';
import { shown_name } from '../names';

export function ByHand({ arm, app }: { arm: Arm; app: App }) {
  const { hand, store } = app;
  useEffect(() => {
    // A key that is let go in another window is not heard of here.
    const let_go = () => hand.let_go();
    window.addEventListener('blur', let_go);
    document.addEventListener('visibilitychange', let_go);
    return () => {
      let_go();
      window.removeEventListener('blur', let_go);
      document.removeEventListener('visibilitychange', let_go);
    };
  }, [hand]);
  const states = store.cell ? states_of(arm_of(store.cell, arm.name)) : [];
  return (
    <section class="by-hand" aria-label={`Jog ${arm.name}`} data-test="by-hand">
      <h3>By hand</h3>
      <Control app={app} />
      {hand.key.value !== null && (
        <div class="line wrap">{states.map((state) => <HoldButton key={state} arm={arm.name} state={state} app={app} />)}</div>
      )}
      {hand.key.value !== null && <p class="hint" role="status" data-test="jog-state">{held_in_words(arm, app)}</p>}
      <InSight answer={hand.refusal.value}>{hand.refusal.value !== null && <p class="refused" role="alert" data-test="jog-refused">{hand.refusal.value}</p>}</InSight>
    </section>
  );
}

function Control({ app }: { app: App }) {
  const { hand, settings, session } = app;
  const mute = why_no_command(app);
  const who = session.value?.name ?? settings.person.value.trim();
  const holder = hand.holder.value;
  if (hand.key.value !== null) {
    return (
      <div class="line wrap">
        <span class="grow">You have control.</span>
        <button class="small" data-test="release-control" onClick={() => void hand.give_back()}>Give control back</button>
      </div>
    );
  }
  return (
    <div class="line wrap">
      <span class="grow dim">{holder ? <><b>{shown_name(holder.who)}</b> has control.</> : 'Nobody has control.'} One person at a time can jog arms.</span>
      {!session.value?.name && (
        <label class="line">Your name <input class="name" type="text" value={settings.person.value} maxLength={100} autocomplete="name" data-test="control-person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
      )}
      <button class="small" data-test="take-control" disabled={mute !== null} title={mute ?? (holder ? 'Their jog motion brakes on its path' : 'Required to jog arms')}
        onClick={() => void hand.take(who)}>{holder ? `Take control from ${shown_name(holder.who)}` : 'Take control'}</button>
    </div>
  );
}

const kKeys = new Set([' ', 'Enter']);

function HoldButton({ arm, state, app }: { arm: string; state: string; app: App }) {
  const { hand } = app;
  const held = hand.held.value;
  const is_held = held?.arm === arm && held.state === state;
  return (
    <button class={`hold${is_held ? ' held' : ''}`} data-test={`jog-${state}`} aria-pressed={is_held}
      title="Hold to move, slowly; let go to brake on the path"
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        void hand.press(arm, state);
      }}
      onPointerUp={() => hand.let_go()} onPointerCancel={() => hand.let_go()} onLostPointerCapture={() => hand.let_go()}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (!kKeys.has(event.key)) return;
        event.preventDefault();
        if (!event.repeat) void hand.press(arm, state);
      }}
      onKeyUp={(event) => { if (kKeys.has(event.key)) hand.let_go(); }}
      onBlur={() => hand.let_go()}
    >Hold: {state}</button>
  );
}

function held_in_words(arm: Arm, app: App): string {
  const held = app.hand.held.value;
  if (held?.arm !== arm.name) return 'Hold a button, or its key (space, Enter), and the arm goes there along a way that the server plans, at a tenth of its speed. Let go, and it brakes.';
  const job = held.job === null ? null : app.store.job(held.job);
  if (!job) return `To ${held.state}: asked.`;
  const why = reason_in_words(job);
  return `To ${held.state}: ${job.state}${why === '' ? '' : `, ${why}`}.`;
}
