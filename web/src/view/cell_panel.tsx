// The 3D view with what is shown over it: smallest clearance, stop, shown time. The 3D view is
// loaded after the rest of the page.

import { useEffect, useRef, useState } from 'preact/hooks';
import { waiting_arms } from '../recovery/needs';
import { Link } from '../route/link';
import { selection_of } from '../route/selection';
import type { Arm } from '../server/messages';
import type { App } from '../state/app';
import type { Shows } from '../state/settings';
import { instant_of, why_unheard } from '../state/instant';
import { is_known, seen_app } from '../state/as_of';
import { use_beats } from '../state/seen';
import { clearance_in_words, clock, millimeters } from '../wording';
import type { CellView } from './cell_view';
import { kText } from '../strings';
import { step_of_key, type CameraStep } from './steer';

const kWords = kText.view;

interface Props { app: App; on_view(view: CellView): void }

export function CellPanel({ app, on_view }: Props) {
  const { store, router, settings } = app;
  const host = useRef<HTMLDivElement>(null);
  const [view, set_view] = useState<CellView | null>(null);
  const [fault, set_fault] = useState<string | null>(null);
  const address = router.address.value;
  useEffect(() => {
    let closed = false;
    let made: CellView | null = null;
    void import('./cell_view').then((module) => {
      if (closed || !host.current) return;
      made = new module.CellView(host.current, app);
      on_view(made);
      set_view(made);
    }).catch((error: unknown) => set_fault(String(error)));
    return () => {
      closed = true;
      made?.close();
    };
  }, [app]);
  useEffect(() => view?.show_selection(selection_of(address.place, store)), [view, address.place, store.arms]);
  useEffect(() => view?.show_instant(address), [view, address.t_s, address.run]);
  useEffect(() => view?.show_camera(address.camera), [view, address.camera]);
  useEffect(() => view?.show_ghost(app.ghost.value), [view, app.ghost.value]);
  useEffect(() => view?.show_theme(), [view, settings.shown_theme.value]);
  return (
    <div class={`cell${app.seen.store.value.stopped ? ' stopped' : ''}`}>
      <div class="view" ref={host} role="img" tabIndex={0} data-test="view"
        aria-label={kWords.label}
        onKeyDown={(event) => {
          const step = event.ctrlKey || event.metaKey || event.altKey ? null : step_of_key(event.key);
          if (step === null) return;
          event.preventDefault();
          view?.steer(step);
        }} />
      {!view && <p class="loading">{fault === null ? kWords.loading : kWords.not_available(fault)}</p>}
      {view && <Waits app={app} />}
      <ClearanceFigure app={app} />
      <InstantMark app={app} />
      <div class="cell-top"><StoppedMark app={seen_app(app)} />{fault === null && <><ShownBar app={app} /><CameraBar view={view} /></>}</div>
    </div>
  );
}

/**
 * States that the view waits for positions, because no arm is drawn before its position is known.
 */
function Waits({ app }: { app: App }) {
  use_beats(app.store);
  return waits_for_first(app) ? <p class="loading" role="status" data-test="no-pose-yet">{kWords.waiting_for_positions}</p> : null;
}

function waits_for_first({ store }: App): boolean {
  return store.link.status !== 'recording' && store.trace.last_s === null && Object.keys(store.q).length === 0;
}

/** States that a past time is shown, or that its positions are unknown. */
function InstantMark({ app }: { app: App }) {
  use_beats(app.store);
  const { store, router } = app;
  const instant = instant_of(router.address.value, store);
  if (store.link.status === 'recording' && store.trace.first_s === null) return <WithoutPositions app={app} />;
  if (instant.kind === 'now' || waits_for_first(app)) return null;
  if (instant.kind === 'kept') return <div class="instant-mark" data-test="instant">{kWords.shown_time(clock(instant.t_s))}</div>;
  const { first_s } = store.trace;
  return (
    <div class="unheard" role="status" data-test="unheard" style={{ '--covered': `${app.covered_px.value}px` }}>
      <p><b>{kWords.unknown_positions}<span class="mono">{clock(instant.t_s)}</span>.</b></p>
      <p class="dim">{why_unheard(instant.why, store)}{is_known(app.seen.store.value) && kWords.lists_are_known}</p>
      <div class="line">
        <button class="small" data-test="unheard-now" onClick={() => router.show_time(null)}>{kText.past.go_to_now}</button>
        {instant.why === 'before' && first_s !== null && <button class="small" onClick={() => router.show_time(first_s)}>{kWords.earliest}</button>}
        <Link app={app} to={{ page: 'recordings' }}>{kWords.open_recording}</Link>
      </div>
    </div>
  );
}

/** States that the recording has no positions, so that no arm is drawn. */
function WithoutPositions({ app }: { app: App }) {
  return (
    <div class="unheard" role="status" data-test="without-positions" style={{ '--covered': `${app.covered_px.value}px` }}>
      <p><b>{kWords.no_positions}</b></p>
      <p class="dim">{kWords.recorded_without}<code>--record</code>{kWords.lists_show}<span class="mono">{clock(app.router.address.value.t_s ?? app.store.t_s)}</span>.</p>
    </div>
  );
}

/** States which arms are stopped or have no link, with a link to the recovery page. */
function StoppedMark({ app }: { app: App }) {
  const { store } = app;
  const waiting = waiting_arms(store);
  const connecting = [...store.arms.values()].filter(({ link }) => link === 'connecting');
  const are_all = store.stopped && connecting.length === 0;
  if (!are_all && waiting.length + connecting.length === 0) return null;
  const words = are_all ? kWords.stopped : `${[...waiting, ...connecting].map(why_at_rest).join(', ')}.`;
  return (
    <div class="stopped-mark" role="status" data-test={are_all ? 'stopped' : 'some-stopped'}>■ {words}{' '}
      <Link app={app} to={{ page: 'recovery' }} test="to-recovery">{kText.common.open_recovery}</Link></div>
  );
}

function why_at_rest({ name, state, link }: Arm): string {
  if (link === 'lost') return kWords.arm_lost(name);
  if (link === 'connecting') return kWords.arm_connecting(name);
  return state === 'fault' ? kWords.arm_fault(name) : kWords.arm_stopped(name);
}

const kShows: readonly [what: keyof Shows, title: string, meaning: string][] = [
  ['paths', kWords.paths, kWords.paths_title],
  ['ghosts', kWords.ghosts, kWords.ghosts_title],
  ['distances', kWords.distances, kWords.distances_title],
];

/** Buttons for the optional parts of the view. */
function ShownBar({ app }: { app: App }) {
  const shows = app.settings.shows.value;
  return (
    <div class="shown-bar" role="group" aria-label={kWords.shown}>
      {kShows.map(([what, title, meaning]) => (
        <button key={what} class="small" aria-pressed={shows[what]} title={meaning} data-test={`show-${what}`}
          onClick={() => app.settings.set_shows({ ...shows, [what]: !shows[what] })}>{title}</button>
      ))}
    </div>
  );
}

const kSteps: readonly [step: CameraStep, sign: string, title: string][] = [
  ['left', '←', kWords.camera_left], ['right', '→', kWords.camera_right], ['up', '↑', kWords.camera_up], ['down', '↓', kWords.camera_down],
  ['nearer', '+', kWords.camera_nearer], ['farther', '−', kWords.camera_farther], ['whole', kWords.show_all_sign, kWords.show_all],
];

/** Buttons that move the camera, for users who cannot drag. */
function CameraBar({ view }: { view: CellView | null }) {
  return (
    <div class="camera-bar" role="group" aria-label={kWords.camera}>
      {kSteps.map(([step, sign, title]) => (
        <button key={step} class="small" disabled={!view} aria-label={title} title={title} data-test={`camera-${step}`} onClick={() => view?.steer(step)}>{sign}</button>
      ))}
    </div>
  );
}

function ClearanceFigure({ app }: { app: App }) {
  const { store } = app;
  use_beats(store);
  const nearest = store.clearance.reduce<(typeof store.clearance)[number] | null>((a, b) => (a && a.m <= b.m ? a : b), null);
  if (!nearest || app.router.address.value.t_s !== null) return null;
  const limit_m = store.cell?.clearance_m ?? 0;
  const level = nearest.m < limit_m ? 'low' : nearest.m < 3 * limit_m ? 'near' : '';
  return (
    <div class={`clearance ${level}`} title={kWords.clearance_title}>
      <span class="dim">{level === 'low' ? kWords.too_close : ''}{clearance_in_words(nearest)}</span> <b class="mono">{millimeters(nearest.m)}</b>
      <div class="small dim">{nearest.links[0]} – {nearest.links[1]}</div>
    </div>
  );
}
