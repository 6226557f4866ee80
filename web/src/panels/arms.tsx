// One card per arm: state, what it does, how far it is; its joints on demand.

import { useState } from 'preact/hooks';
import { range_of, type Arm, type CellJoint } from '../messages';
import { arm_colour, kStateColours } from '../palette';
import type { Store } from '../store';
import { short_id } from '../wording';
import { use_store } from './use_store';

export function Arms({ store }: { store: Store }) {
  use_store(store, 'live');
  const [open, set_open] = useState(false);
  const arms = [...store.arms.values()];
  return (
    <section class="arms">
      <h2>
        Arms
        <button class="quiet" aria-pressed={open} onClick={() => set_open(!open)}>{open ? 'hide joints' : 'joints'}</button>
      </h2>
      <div class="cards">
        {arms.map((arm) => <ArmCard key={arm.name} arm={arm} store={store} open={open} />)}
      </div>
    </section>
  );
}

function ArmCard({ arm, store, open }: { arm: Arm; store: Store; open: boolean }) {
  const colour = arm_colour([...store.arms.keys()], arm.name);
  const job = arm.job === null ? null : store.job(arm.job);
  const progress = job ? store.progress(job) : 0;
  return (
    <div class="card" style={{ '--arm': colour, '--state': kStateColours[arm.state] }} data-test={`arm-${arm.name}`}>
      <div class="line">
        <span class="swatch" />
        <b class="grow ellipsis">{arm.name}</b>
        <span class="pill">{arm.state}</span>
      </div>
      <div class="line dim">
        <span class="grow ellipsis">{job ? job.name || short_id(job.id) : arm.job ? short_id(arm.job) : 'no job'}</span>
        <span class="mono">{job ? `${Math.round(100 * progress)} %` : ''}</span>
      </div>
      <Bar share={progress} />
      {open && <Joints arm={arm} store={store} />}
    </div>
  );
}

function Joints({ arm, store }: { arm: Arm; store: Store }) {
  const q = store.q_of(arm);
  const limits = new Map(store.cell?.joints.map((joint) => [joint.name, joint]));
  return (
    <div class="joints" data-test={`joints-${arm.name}`}>
      {arm.joints.map((name, i) => <Joint key={name} name={name} n={i + 1} value={q[i] ?? 0} limits={limits.get(name)} />)}
      <div class="line dim small"><span class="grow">off path</span><span class="mono">{arm.deviation_rad.toFixed(4)} rad</span></div>
    </div>
  );
}

function Joint({ name, n, value, limits }: { name: string; n: number; value: number; limits: CellJoint | undefined }) {
  const [lower, upper] = limits ? range_of(limits) : [-Infinity, Infinity];
  const span = Number.isFinite(upper - lower) ? upper - lower : 2 * Math.PI;
  const share = Math.min(1, Math.max(0, (value - (Number.isFinite(lower) ? lower : -Math.PI)) / span));
  return (
    <div class="joint" title={limits ? `${name}: ${lower} … ${upper} ${limits.unit}` : name}>
      <span>{n}</span>
      <span class="gauge"><span style={{ left: `${100 * share}%` }} /></span>
      <span class="mono">{value.toFixed(3)}</span>
    </div>
  );
}

export function Bar({ share }: { share: number }) {
  return <div class="bar"><div style={{ transform: `scaleX(${share.toFixed(4)})` }} /></div>;
}
