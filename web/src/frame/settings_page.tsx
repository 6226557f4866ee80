// How this browser shows the page, and which keys it has.

import type { App } from '../state/app';
import type { Theme } from '../state/settings';
import { seconds } from '../wording';
import { Link } from '../route/link';
import { kPages } from './pages';
import { PolicyForm } from './policy_form';

const kThemes: readonly [Theme, string][] = [['system', 'As the system'], ['dark', 'Dark'], ['light', 'Light']];
const kIdleBlockers = { report: 'is only reported', park: 'is sent aside', replan: 'is passed by another way, if there is one' };
const kKeys: readonly [string, string][] = [
  ['F8', 'Stop all, wherever the focus is'], ['Escape', 'Back to the cell'],
  ...kPages.map(({ key, title }): [string, string] => [key, title]),
  ['← →  + −  0', 'In the timeline: move, zoom, follow now'],
  ['← → ↑ ↓  + −  0', 'In the cell: turn it, nearer, farther, all'],
];

export function SettingsPage({ app }: { app: App }) {
  const { settings, store } = app;
  const session = app.session.value;
  const log_out = async () => {
    if (await app.actions.ask('Log out', app.api.log_out())) location.assign('/login');
  };
  const { cell } = store;
  return (
    <div class="columns">
      <section>
        <h2>Appearance</h2>
        <fieldset class="choices">
          <legend>Theme</legend>
          {kThemes.map(([theme, title]) => (
            <label key={theme}>
              <input type="radio" name="theme" value={theme} checked={settings.theme.value === theme} onChange={() => settings.set_theme(theme)} /> {title}
            </label>
          ))}
        </fieldset>
        {session?.auth_required && (
          <>
            <h2>You</h2>
            <p data-test="session"><b>{session.name}</b>, {session.role} <button class="small" data-test="log-out" onClick={() => void log_out()}>Log out</button></p>
          </>
        )}
        <h2>Keys</h2>
        <label class="check">
          <input type="checkbox" checked={settings.letter_keys.value} onChange={(event) => settings.set_letter_keys(event.currentTarget.checked)} />
          {' '}Single letters open pages
        </label>
        <dl class="keys-list">
          {kKeys.map(([key, what]) => <div key={key}><dt><kbd>{key}</kbd></dt><dd>{what}</dd></div>)}
        </dl>
      </section>
      {cell && (
        <section>
          <h2>The cell</h2>
          <p class="hint">Set by the cell file and by how the server was started.</p>
          <dl class="facts-list" data-test="cell-facts">
            {([
              ['Cell', cell.name], ['Speed', `× ${store.speed}`], ['Arms', String(store.arms.size)],
              ['Clearance', `${(1000 * cell.clearance_m).toFixed(0)} mm`],
              ['Monitor stops below', `${(1000 * cell.monitor.stop_clearance_m).toFixed(0)} mm`],
              ['Backlog timeout', seconds(cell.scheduling.backlog_timeout_s)],
              ['A waiting job is overtaken for at most', seconds(cell.scheduling.aging_s)],
              ['Admitted ahead', `${cell.scheduling.horizon_steps} jobs of each arm`],
              ['An idle arm in the way', kIdleBlockers[cell.scheduling.on_idle_blocker]],
            ] as const).map(([what, value]) => <div key={what}><dt>{what}</dt><dd>{value}</dd></div>)}
          </dl>
          <h2>The policy</h2>
          <PolicyForm app={app} />
          <p class="hint"><Link app={app} to={{ page: 'policies' }} test="compare-policies">What would the others have done with today's jobs?</Link></p>
          <p class="hint"><a class="link" href="/docs">The API, for programs</a></p>
        </section>
      )}
    </div>
  );
}
