// An arm by hand: buttons that move it to its named states as long as they are held.

import { useEffect } from 'preact/hooks';
import { arm_of, states_of } from '../compose/goal';
import { InSight } from '../frame/in_sight';
import type { Arm } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { reason_in_words } from '../wording';
import { shown_name } from '../names';
import { kText } from '../strings';

const kWords = kText.jog;

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
    <section class="by-hand" aria-label={kWords.label(arm.name)} data-test="by-hand">
      <h3>{kWords.title}</h3>
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
        <span class="grow">{kWords.you_have_control}</span>
        <button class="small" data-test="release-control" onClick={() => void hand.give_back()}>{kWords.release}</button>
      </div>
    );
  }
  return (
    <div class="line wrap">
      <span class="grow dim">{holder ? kWords.has_control(shown_name(holder.who)) : kWords.no_control} {kWords.one_person}</span>
      {!session.value?.name && (
        <label class="line">{kText.common.your_name} <input class="name" type="text" value={settings.person.value} maxLength={100} autocomplete="name" data-test="control-person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
      )}
      <button class="small" data-test="take-control" disabled={mute !== null} title={mute ?? (holder ? kWords.stops_their_motion : kWords.required)}
        onClick={() => void hand.take(who)}>{holder ? kWords.take_from(shown_name(holder.who)) : kWords.take}</button>
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
      title={kWords.button_title}
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
    >{kWords.button(state)}</button>
  );
}

function held_in_words(arm: Arm, app: App): string {
  const held = app.hand.held.value;
  if (held?.arm !== arm.name) return kWords.hint;
  const job = held.job === null ? null : app.store.job(held.job);
  if (!job) return kWords.requested(held.state);
  return kWords.moving(held.state, job.state, reason_in_words(job));
}
