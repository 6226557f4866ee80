// The Settings page: theme, user, keys, the settings of the cell, the policy.

import { address_on_server } from '../server/api';
import type { App } from '../state/app';
import type { Theme } from '../state/settings';
import { seconds } from '../wording';
import { Link } from '../route/link';
import { kPages } from './pages';
import { kText } from '../strings';
import { Faults } from './fault_form';
import { PolicyForm } from './policy_form';

const kWords = kText.settings;

const kThemes: readonly [Theme, string][] = [['system', kWords.themes.system], ['dark', kWords.themes.dark], ['light', kWords.themes.light]];
const kKeys: readonly [string, string][] = [
  ['F8', kWords.key_stop], ['Escape', kWords.key_escape],
  ...kPages.map(({ key, title }): [string, string] => [key, title]),
  ['← →  + −  0', kWords.key_timeline],
  ['← → ↑ ↓  + −  0', kWords.key_view],
];

export function SettingsPage({ app }: { app: App }) {
  const { settings, store } = app;
  const session = app.session.value;
  const log_out = async () => {
    if (await app.actions.ask(kWords.log_out, app.api.log_out())) location.assign(address_on_server('login'));
  };
  const { cell } = store;
  return (
    <div class="columns">
      <section>
        <h2>{kWords.appearance}</h2>
        <fieldset class="choices">
          <legend>{kWords.theme}</legend>
          {kThemes.map(([theme, title]) => (
            <label key={theme}>
              <input type="radio" name="theme" value={theme} checked={settings.theme.value === theme} onChange={() => settings.set_theme(theme)} /> {title}
            </label>
          ))}
        </fieldset>
        {session?.auth_required && (
          <>
            <h2>{kWords.user}</h2>
            <p data-test="session"><b>{session.name}</b>, {session.role} <button class="small" data-test="log-out" onClick={() => void log_out()}>{kWords.log_out}</button></p>
          </>
        )}
        <h2>{kWords.keys}</h2>
        <label class="check">
          <input type="checkbox" checked={settings.letter_keys.value} onChange={(event) => settings.set_letter_keys(event.currentTarget.checked)} />
          {' '}{kWords.letter_keys}
        </label>
        <dl class="keys-list">
          {kKeys.map(([key, what]) => <div key={key}><dt><kbd>{key}</kbd></dt><dd>{what}</dd></div>)}
        </dl>
      </section>
      {cell && (
        <section>
          <h2>{kWords.cell}</h2>
          <p class="hint">{kWords.cell_hint}</p>
          <dl class="facts-list" data-test="cell-facts">
            {([
              [kWords.cell_name, cell.name], [kWords.speed, kWords.speed_value(store.speed)], [kWords.arms, String(store.arms.size)],
              [kWords.clearance, `${(1000 * cell.clearance_m).toFixed(0)} mm`],
              [kWords.stop_clearance, `${(1000 * cell.monitor.stop_clearance_m).toFixed(0)} mm`],
              [kWords.backlog_timeout, seconds(cell.scheduling.backlog_timeout_s)],
              [kWords.aging, seconds(cell.scheduling.aging_s)],
              [kWords.horizon, kWords.horizon_value(cell.scheduling.horizon_steps)],
              [kWords.idle_blocker, kWords.idle_blockers[cell.scheduling.on_idle_blocker]],
            ] as const).map(([what, value]) => <div key={what}><dt>{what}</dt><dd>{value}</dd></div>)}
          </dl>
          <h2>{kText.policies.title}</h2>
          <PolicyForm app={app} />
          <p class="hint"><Link app={app} to={{ page: 'policies' }} test="compare-policies">{kWords.compare}</Link></p>
          <Faults app={app} cell={cell} />
          <p class="hint"><a class="link" href={address_on_server('docs')}>{kWords.api}</a></p>
        </section>
      )}
    </div>
  );
}
