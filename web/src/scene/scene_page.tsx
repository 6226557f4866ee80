// The Scene page: the list of objects, and a form to add, change and remove them.

import { useEffect, useState } from 'preact/hooks';
import { Refused } from '../compose/refused';
import { AsOf } from '../frame/as_of';
import { InSight } from '../frame/in_sight';
import { NumberField } from '../frame/number_field';
import { use_question } from '../frame/question';
import { Link } from '../route/link';
import { shape_of, type Problem, type SceneObject } from '../server/messages';
import type { App } from '../state/app';
import { arm_color } from '../state/palette';
import { why_no_command } from '../state/permission';
import { number_in_words } from '../wording';
import { blank_form, edits_since, fault_of_name, fields_of, form_of, kKinds, kLongestName, object_of, with_edits, type Edits, type Kind } from './object_form';
import { LetGo } from './let_go';
import { shown_name } from '../names';
import { holders_of } from '../state/facts';
import { kText } from '../strings';

const kWords = kText.scene;

export function ScenePage({ name, app }: { name: string | null; app: App }) {
  const { objects, held } = app.store;
  const chosen = objects.find((object) => object.name === name) ?? null;
  const chosen_held = held.find(({ object }) => object.name === name) ?? null;
  return (
    <div class="page">
      <h2>{kText.page.scene}<span class="count">{objects.length + held.length}</span></h2>
      {app.router.address.value.t_s === null
        ? <p class="hint">{kWords.hint}</p>
        : <AsOf app={app}>{kWords.past}</AsOf>}
      <ul class="objects" data-test="objects">
        {objects.map((object) => <Entry key={object.name} object={object} arms={[]} chosen={name} app={app} />)}
        {held.map((one) => <Entry key={one.object.name} object={one.object} arms={holders_of(one)} chosen={name} app={app} />)}
      </ul>
      {chosen_held && <p class="hint" data-test="object-held">{kWords.held_sentence(shown_name(chosen_held.object.name), holders_of(chosen_held).map(shown_name), shown_name(chosen_held.link))}</p>}
      {chosen_held && app.router.address.value.t_s === null && <LetGo object={chosen_held.object.name} arm={holders_of(chosen_held).join(', ')} app={app} />}
      {name !== null && !chosen && !chosen_held && <p class="hint">{app.router.address.value.t_s === null ? kWords.none_called(shown_name(name)) : kWords.none_called_then(shown_name(name))}</p>}
      {chosen && app.router.address.value.t_s === null && <DragButton name={chosen.name} app={app} />}
      {chosen?.mesh !== undefined
        ? <p class="hint">{kWords.mesh}</p>
        : !chosen_held && <ObjectForm key={chosen?.name ?? 'new'} chosen={chosen} app={app} />}
    </div>
  );
}

/** One object of the list. `arms` hold it. */
function Entry({ object, arms, chosen, app }: { object: SceneObject; arms: string[]; chosen: string | null; app: App }) {
  const all = [...app.store.arms.keys()];
  return (
    <li class={object.name === chosen ? 'selected' : ''}>
      <Link app={app} to={{ page: 'scene', name: object.name }} class="open" current={object.name === chosen}>
        <span class="ellipsis" title={shown_name(object.name)}>{shown_name(object.name)}</span>
        <span class="line">
          {arms.map((arm) => <span key={arm} class="tag" data-test="held-by" style={{ '--arm': arm_color(all, arm) }}>{kWords.held_by(shown_name(arm))}</span>)}
          <span class="dim small">{size_in_words(object)}</span>
        </span>
      </Link>
    </li>
  );
}

/**
 * Enables dragging of the object. Objects cannot be dragged without it, because a moved object can
 * pause motions.
 */
function DragButton({ name, app }: { name: string; app: App }) {
  const is_dragged = app.dragged_object.value === name;
  useEffect(() => () => { app.dragged_object.value = null; }, [app, name]);
  return (
    <div class="line">
      <button class="small" aria-pressed={is_dragged} data-test="move-object" onClick={() => { app.dragged_object.value = is_dragged ? null : name; }}>{kWords.drag}</button>
      <span class="dim small">{is_dragged ? kWords.drag_hint : kWords.or_form}</span>
    </div>
  );
}

function size_in_words(object: SceneObject): string {
  const shape = shape_of(object);
  switch (shape?.kind) {
    case 'box': return kWords.box(shape.size.map(number_in_words).join(' × '));
    case 'cylinder': return kWords.cylinder(number_in_words(shape.radius), number_in_words(shape.length));
    case 'sphere': return kWords.sphere(number_in_words(shape.radius));
    case 'mesh': return kWords.mesh_size;
    default: return '';
  }
}

function ObjectForm({ chosen, app }: { chosen: SceneObject | null; app: App }) {
  const [edits, set_edits] = useState<Edits>({});
  const edit = (more: Edits) => set_edits((now) => ({ ...now, ...more, values: { ...now.values, ...more.values } }));
  const form = with_edits(chosen ? form_of(chosen) : blank_form(), edits);
  const [problem, set_problem] = useState<Problem | null>(null);
  const why_disabled = why_no_command(app);
  const name_fault = form.name === '' ? null : fault_of_name(form.name);
  const submit = async (event: Event) => {
    event.preventDefault();
    const object = object_of(form);
    if ('fault' in object) return set_problem({ type: 'about:blank', title: kWords.incomplete, status: 0, detail: object.fault });
    const answer = await app.api.put_object(object);
    set_problem(answer.ok ? null : answer.problem);
    if (!answer.ok) return;
    if (chosen) set_edits((now) => edits_since(form, now));
    app.router.go({ page: 'scene', name: object.name });
  };
  return (
    <form class="object-form" data-test="object-form" onSubmit={(event) => void submit(event)}>
      <h3>{chosen ? kWords.change_object(shown_name(chosen.name)) : kWords.add_object}</h3>
      <div class="line wrap">
        <label class="name">{kWords.name} <input type="text" required maxLength={kLongestName} value={form.name} readOnly={chosen !== null} data-test="object-name" aria-invalid={name_fault !== null} aria-describedby="object-name-fault"
          onInput={(event) => edit({ name: event.currentTarget.value })} /></label>
        <label>{kWords.shape} <select value={form.kind} data-test="object-kind" onChange={(event) => edit({ kind: event.currentTarget.value as Kind })}>
          {kKinds.map((kind) => <option key={kind} value={kind}>{kind}</option>)}
        </select></label>
        <span id="object-name-fault" class="field-fault" role="status" data-test="object-name-fault">{name_fault}</span>
      </div>
      {fields_of(form.kind).map(({ legend, keys }) => (
        <fieldset key={legend}>
          <legend>{legend}</legend>
          {keys.map(([key, label, step]) => (
            <label key={key}>{label} <NumberField value={form.values[key] ?? ''} step={step} test={`object-${key}`} change={(text) => edit({ values: { [key]: text } })} /></label>
          ))}
        </fieldset>
      ))}
      <div class="line">
        <button class="primary" type="submit" data-test="object-save" disabled={why_disabled !== null || name_fault !== null} title={why_disabled ?? name_fault ?? ''}>{chosen ? kWords.change : kWords.add}</button>
        {chosen && <Remove object={chosen} app={app} />}
        {chosen && <Link app={app} to={{ page: 'scene', name: null }}>{kWords.add_another}</Link>}
      </div>
      <InSight answer={problem}>{problem && <Refused problem={problem} />}</InSight>
    </form>
  );
}

function Remove({ object, app }: { object: SceneObject; app: App }) {
  const question = use_question();
  const why_disabled = why_no_command(app);
  const remove = async () => {
    if (await app.actions.ask(kText.command.remove(object.name), app.api.remove_object(object.name))) app.router.go({ page: 'scene', name: null });
  };
  return question.asked
    ? <><button type="button" class="danger" data-test="object-removal" disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={() => void remove()}>{kWords.remove_object(shown_name(object.name))}</button><button type="button" onClick={question.take_back}>{kText.common.keep}</button></>
    : <button ref={question.button} type="button" data-test="object-remove" disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={question.ask}>{kWords.remove}</button>;
}
