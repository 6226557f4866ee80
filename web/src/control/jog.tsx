// Jogs an arm (hold-to-run): buttons that move it to its named states while they are held.

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

export function JogPanel({ arm, app }: { arm: Arm; app: App }) {
  const { jogging, store } = app;
  useEffect(() => {
    // A key released in another window sends no event here.
    const release = () => jogging.release();
    window.addEventListener('blur', release);
    document.addEventListener('visibilitychange', release);
    return () => {
      release();
      window.removeEventListener('blur', release);
      document.removeEventListener('visibilitychange', release);
    };
  }, [jogging]);
  const states = store.cell ? states_of(arm_of(store.cell, arm.name)) : [];
  return (
    <section class="jog" aria-label={kWords.label(arm.name)} data-test="jog">
      <h3>{kWords.title}</h3>
      <Control app={app} />
      {jogging.key.value !== null && (
        <div class="line wrap">{states.map((state) => <JogButton key={state} arm={arm.name} state={state} app={app} />)}</div>
      )}
      {jogging.key.value !== null && <p class="hint" role="status" data-test="jog-state">{state_in_words(arm, app)}</p>}
      <InSight answer={jogging.refusal.value}>{jogging.refusal.value !== null && <p class="refused" role="alert" data-test="jog-refused">{jogging.refusal.value}</p>}</InSight>
    </section>
  );
}

function Control({ app }: { app: App }) {
  const { jogging, settings, session } = app;
  const why_disabled = why_no_command(app);
  const who = session.value?.name ?? settings.person.value.trim();
  const holder = jogging.holder.value;
  if (jogging.key.value !== null) {
    return (
      <div class="line wrap">
        <span class="grow">{kWords.you_have_control}</span>
        <button class="small" data-test="release-control" onClick={() => void jogging.release_control()}>{kWords.release}</button>
      </div>
    );
  }
  return (
    <div class="line wrap">
      <span class="grow dim">{holder ? kWords.has_control(shown_name(holder.who)) : kWords.no_control} {kWords.one_person}</span>
      {!session.value?.name && (
        <label class="line">{kText.common.your_name} <input class="name" type="text" value={settings.person.value} maxLength={100} autocomplete="name" data-test="control-person" onInput={(event) => settings.set_person(event.currentTarget.value)} /></label>
      )}
      <button class="small" data-test="take-control" disabled={why_disabled !== null} title={why_disabled ?? (holder ? kWords.stops_their_motion : kWords.required)}
        onClick={() => void jogging.take(who)}>{holder ? kWords.take_from(shown_name(holder.who)) : kWords.take}</button>
    </div>
  );
}

const kKeys = new Set([' ', 'Enter']);

function JogButton({ arm, state, app }: { arm: string; state: string; app: App }) {
  const { jogging } = app;
  const pressed = jogging.pressed.value;
  const is_pressed = pressed?.arm === arm && pressed.state === state;
  return (
    <button class={`jog-button${is_pressed ? ' pressed' : ''}`} data-test={`jog-${state}`} aria-pressed={is_pressed}
      title={kWords.button_title}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        void jogging.press(arm, state);
      }}
      onPointerUp={() => jogging.release()} onPointerCancel={() => jogging.release()} onLostPointerCapture={() => jogging.release()}
      onContextMenu={(event) => event.preventDefault()}
      onKeyDown={(event) => {
        if (!kKeys.has(event.key)) return;
        event.preventDefault();
        if (!event.repeat) void jogging.press(arm, state);
      }}
      onKeyUp={(event) => { if (kKeys.has(event.key)) jogging.release(); }}
      onBlur={() => jogging.release()}
    >{kWords.button(state)}</button>
  );
}

function state_in_words(arm: Arm, app: App): string {
  const pressed = app.jogging.pressed.value;
  if (pressed?.arm !== arm.name) return kWords.hint;
  const job = pressed.job === null ? null : app.store.job(pressed.job);
  if (!job) return kWords.requested(pressed.state);
  return kWords.moving(pressed.state, job.state, reason_in_words(job));
}
