// A button that makes an object that an arm holds part of the scene.

import { use_question } from '../frame/question';
import { shown_name } from '../names';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { kText } from '../strings';

const kWords = kText.scene;

/** Asks before it lets go: the gripper does not move, so the object may fall. */
export function LetGo({ object, arm, app }: { object: string; arm: string; app: App }) {
  const question = use_question();
  const why_disabled = why_no_command(app);
  const let_go = async () => {
    if (!await app.actions.ask(kText.command.let_go(object), app.api.detach_object(object))) question.take_back();
  };
  return question.asked
    ? <><p class="hint" role="status">{kWords.let_go_means(shown_name(arm))}</p>
      <div class="line">
        <button type="button" class="danger small" data-test="let-go-now" disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={() => void let_go()}>{kWords.let_go_now(shown_name(object))}</button>
        <button type="button" class="small" onClick={question.take_back}>{kText.common.keep}</button>
      </div></>
    : <div class="line"><button ref={question.button} type="button" class="small" data-test="let-go" disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={question.ask}>{kWords.let_go(shown_name(object))}</button></div>;
}
