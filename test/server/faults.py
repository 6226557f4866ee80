#!/usr/bin/env python3
"""faults.py [--tree DIR] [--only REGEX] [--patterns]: puts faults into a copy of the server, the monitor, the arms and the
dashboard, all in one build, and switches them on one at a time. Prints the first test that finds each fault, and its time in
seconds; exit 1 if a fault is not found. A program is built when it first runs, and must pass without a fault. --only takes the
faults whose "GROUP: NAME" matches, for example --only monitor_test. --tree keeps the copy. --patterns only checks that each
fault still matches its source."""
import argparse, os, re, subprocess, sys, tempfile, time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from fault_tree import TOP, build, copy, failed_in, put_in, run

STORE, TABLES, MARK = 'server/store/job_store.cc', 'server/store/job_tables.cc', 'server/store/store_mark.cc'
RESTART, ACCEPTED = 'server/durable/restart.cc', 'server/durable/accepted_requests.cc'
HEAD, FRAMING, ROUTER = 'server/http/request_head.cc', 'server/http/framing.cc', 'server/http/router.cc'
LIMITS, STATES = 'server/http/client_limits.cc', 'server/recording/states_csv.cc'
PREMISES, AHEAD, STOPS = 'core/monitor/premises.cc', 'core/monitor/look_ahead.cc', 'core/monitor/stop_set.cc'
MOVES = 'core/monitor/moves_on.cc'
MONITOR, HUB, FAULTY = 'core/monitor/present.cc', 'server/hub/hub.cc', 'core/arm/faulty_arm.cc'
PROGRESS, RATES = 'core/arm/commanded_progress.cc', 'core/trajectory/rate_law.cc'
DISTANCE, REST = 'core/monitor/path_distance.cc', 'core/monitor/earliest_rest.cc'
LINK, WATCH = 'core/arm/arm_link.cc', 'core/executive/link_watch.cc'
PROMISES, ERRORS = 'core/model/promises.h', 'core/coordination/tracking_errors.h'

# Faults by the test program that runs first. If it does not find a fault, the other programs run.
FAULTS = {'server_store_test': [
    ('a write that failed is acknowledged', STORE, 'one.done(false);', 'one.done(FAULT);'),
    ('changes that could not be written are dropped', STORE, '      pending_ = std::move(batch);', '      if (!FAULT) pending_ = std::move(batch);'),
    ('a disk fault never ends', STORE, 'was_faulty = std::exchange(fault_, std::nullopt).has_value();', 'was_faulty = !FAULT && std::exchange(fault_, std::nullopt).has_value();'),
    ('the store does not wait for the disk', TABLES, 'database.run("PRAGMA synchronous = FULL; PRAGMA', 'database.run(std::string("PRAGMA synchronous = ") + (FAULT ? "OFF" : "FULL") + "; PRAGMA'),
    ('a job that may have moved is stored as unmoved', TABLES, 'if (change.may_have_moved) move_', 'if (change.may_have_moved && !FAULT) move_'),
    ('an amendment is not stored', TABLES, '  if (change.amended) amend_', '  if (change.amended && !FAULT) amend_'),
    ('a damaged job counts as sound', TABLES, 'found.is_damaged = jobs.number(9) != 0;', 'found.is_damaged = !FAULT && jobs.number(9) != 0;'),
    ('old stops remain stored', TABLES, '    forget_stops_.run();', '    if (!FAULT) forget_stops_.run();'),
    ('a damaged stop is skipped', TABLES, 'left.stops_are_damaged = true;', 'left.stops_are_damaged = !FAULT;'),
    ('a removed object comes back', TABLES, 'if (!object.text && !object.is_of_cell) return', 'if (FAULT && !object.text) return;\n  if (!object.text && !object.is_of_cell) return'),
    ('cleaning deletes the newest jobs', TABLES, 'remove("SELECT number FROM job WHERE has_ended = 1 ORDER BY ended_ms LIMIT min(?1, ?2)", over);', 'remove(FAULT ? "SELECT number FROM job WHERE has_ended = 1 ORDER BY ended_ms DESC LIMIT min(?1, ?2)" : "SELECT number FROM job WHERE has_ended = 1 ORDER BY ended_ms LIMIT min(?1, ?2)", over);'),
    ('job numbers are used twice', TABLES, '") AND number < (SELECT max(number) FROM job)");', '(FAULT ? ")" : ") AND number < (SELECT max(number) FROM job)"));'),
    ('an idempotency key is bound again', TABLES, '"INSERT OR IGNORE INTO request(key', 'std::string(FAULT ? "INSERT OR REPLACE" : "INSERT OR IGNORE") + " INTO request(key'),
    ('a stop ahead of the disk is not marked', MARK, 'const bool are_ahead = stops_told_ > stops_written_ ||', 'const bool are_ahead = (!FAULT && stops_told_ > stops_written_) ||'),
    ('an older copy of the store is not noticed', MARK, 'left->commits > commits_, left', '!FAULT && left->commits > commits_, left'),
    ('the older of two changes of a job is written', 'server/store/pending.cc', 'if (change.seen) mine', 'if (change.seen && !(FAULT && mine.seen)) mine'),
], 'server_http_test': [
    ('a page of the audit log is unbounded', 'server/store/job_history.cc', 'while (found.entries.size() < most && row.step())', 'while ((FAULT || found.entries.size() < most) && row.step())'),
    ('a job that was moving runs again after a restart', RESTART, '  if (left.may_have_moved) {', '  if (left.may_have_moved && !FAULT) {'),
    ('a restart starts jobs whose predecessor failed', RESTART, '  if (failed_before(request)) {', '  if (failed_before(request) && !FAULT) {'),
    ('a restart does not wait for resume', RESTART, 'const bool asks = cell', 'const bool asks = !FAULT && cell'),
    ('a restart forgets stopped arms', RESTART, 'if (!arms.empty()) executive', 'if (!arms.empty() && !FAULT) executive'),
    ('unknown stops are taken as no stops', RESTART, '} else if (!knows_stops_) {', '} else if (!knows_stops_ && !FAULT) {'),
    ('two requests with one key run side by side', ACCEPTED, 'if (taken == under_way_.end()) continue;', 'if (FAULT || taken == under_way_.end()) continue;'),
    ('an object that the operator removed comes back after a restart', RESTART, 'if (!stored.text) return is_there ?', 'if (!stored.text) return is_there && !FAULT ?'),
    ('pages of other sites may command', HEAD, 'request.foreign = request.stranger ?', 'request.foreign = request.stranger || FAULT ?'),
    ('a rebound host name is served', HEAD, 'if (authority.empty() || is_allowed_host', 'if (FAULT || authority.empty() || is_allowed_host'),
    ('a handshake without a sound key is accepted', HEAD, 'if (keys.size() == 1 && is_websocket_key', 'if (FAULT || keys.size() == 1 && is_websocket_key'),
    ('Content-Length may occur twice', HEAD, 'if (values.size() < 2) continue;', 'if (values.size() < 2 || (FAULT && name == "Content-Length")) continue;'),
    ('Content-Length is accepted with Transfer-Encoding', FRAMING, '  if (!lengths.empty()) {', '  if (!lengths.empty() && !FAULT) {'),
    ('roles are not checked', ROUTER, 'if (role && guard_) {', 'if (role && guard_ && !FAULT) {'),
    ('unknown query parameters are ignored', 'server/http/message.cc', 'if (std::ranges::find(known, name) != known.end()) continue;', 'if (FAULT || std::ranges::find(known, name) != known.end()) continue;'),
    ('a client may send any number of requests', LIMITS, '  one.requests.take(1);', '  if (!FAULT) one.requests.take(1);'),
    ('a batch counts as one job', LIMITS, '  one.jobs.take(asked);', '  one.jobs.take(FAULT ? 1.0 : asked);'),
    ('every entity tag fits', 'server/http/entity_tag.cc', 'if (fits(one)) return true;', 'if (FAULT || fits(one)) return true;'),
    ('answers of any size are held in memory', 'server/http/session.cc', 'if (response.shared || charge', 'if (FAULT || response.shared || charge'),
    ('a removed token still works', 'server/access/token_book.cc', '  if (is_gone) tokens_.clear();', '  if (is_gone && !FAULT) tokens_.clear();'),
    ('a page of jobs has one too many', 'server/api/job_filter.cc', 'if (page.jobs.size() == filter.limit) {', 'if (page.jobs.size() == filter.limit + (FAULT ? 1 : 0)) {'),
    ('the next page begins with the last job again', 'server/api/job_filter.cc', 'job.id.value() >= *filter.before', 'job.id.value() >= *filter.before + (FAULT ? 1 : 0)'),
    ('an atomic batch is accepted in part', 'server/api/batch_route.cc', '  if (problems.empty()) return std::nullopt;', '  if (FAULT || problems.empty()) return std::nullopt;'),
    ('a batch answers its jobs in the wrong places', 'server/api/batch_route.cc', '      all.ids[i] = job->key;', '      all.ids[FAULT ? 0 : i] = job->key;'),
    ('a late subscriber misses events without notice', HUB, 'if (behind() > hub_.ring_.size()) return std::nullopt;', 'if (behind() > hub_.ring_.size()) {\n      if (!FAULT) return std::nullopt;\n      read_ = hub_.last_seq_ - hub_.ring_.size();\n    }'),
    ('a slow subscriber keeps all frames in memory', HUB, '  while (ring_.size() > capacity_ ||', '  while ((!FAULT && ring_.size() > capacity_) ||'),
    ('a resumed stream repeats its last event', HUB, 'std::make_shared<Reader>(*this, since, std::move(first));', 'std::make_shared<Reader>(*this, FAULT && since > 0 ? since - 1 : since, std::move(first));'),
    ('recent states are never dropped', 'server/hub/recent_states.cc', 'if (frames_.size() > kFramesMax)', 'if (frames_.size() > kFramesMax && !FAULT)'),
], 'server_operator_test': [
    ('any key gives control', 'server/control/control.cc', 'if (holder_ && equal_in', 'if (holder_ && FAULT) return {};\n  if (holder_ && equal_in'),
    ('a lease never ends', 'server/control/control.cc', 'if (now - move.held_at > lease) return false;', 'if (now - move.held_at > lease && !FAULT) return false;'),
    ('control is taken from its holder without asking', 'server/control/control.cc', 'if (holder_ && !from_another) {', 'if (holder_ && !from_another && !FAULT) {'),
], 'server_codec_test': [
    ('omitted rows of a rest are not listed', STATES, '    idle_.write({*rest_from_, held_at_});', '    if (!FAULT) idle_.write({*rest_from_, held_at_});'),
    ('the last row of a rest is lost', STATES, '  if (rows_held_ > 0) append', '  if (rows_held_ > 0 && !FAULT) append'),
    ('times of a recording may go back', STATES, 'if (!states.empty() && state.time <= states', 'if (!FAULT && !states.empty() && state.time <= states'),
    ('a gap in a recording is not reported', STATES, '} else if (state.time - before.time > kGapMax) {', '} else if (state.time - before.time > kGapMax && !FAULT) {'),
], 'monitor_test': [
    ('a pair that comes closer is not reported again', MONITOR, 'stays && !stops.empty() &&', '!FAULT && stays && !stops.empty() &&'),
    ('arms at rest are stopped', MONITOR, 'if (!arm || !moving.at(arm->index())) continue;', 'if (!arm || (!FAULT && !moving.at(arm->index()))) continue;'),
    ('a contact is reported as a lost clearance', MONITOR, '.kind = proximity.clearance_m <= 0.0 ?', '.kind = proximity.clearance_m <= (FAULT ? -1e9 : 0.0) ?'),
    ('a pair that parted stays known', MONITOR, 'if (now - *parted.parted_at < kSameCondition)', 'if (FAULT || now - *parted.parted_at < kSameCondition)'),
    ('a pair that noise takes across its limit is reported each time', MONITOR, '(is_known && stops.empty())) continue;', '(is_known && stops.empty() && !FAULT)) continue;'),
    ('a pair that comes back in motion stops no arm', MONITOR, 'is_known && !before->second.parted_at;', 'is_known && (FAULT || !before->second.parted_at);'),
    ('a deviation is not noticed', PREMISES, 'const bool deviates = far.distance > far_limit;', 'const bool deviates = !FAULT && far.distance > far_limit;'),
    ('a lagging arm deviates', PREMISES, 'state.joints, now.measured,\n                         std::max(now', 'state.joints, now.measured,\n                         std::max(FAULT ? now.measured : now'),
    ('only the first joint is compared with the path', DISTANCE, 'if (away > far.distance) far =', 'if (away > far.distance && !(FAULT && row != rows_.front())) far ='),
    ('the search of the path ends at its samples', DISTANCE, 'i < kHalvings &&', 'i < (FAULT ? 0 : kHalvings) &&'),
    ('an arm may be ahead of its commands', PREMISES, 'now.measured), seen.measured, limit);', 'FAULT ? now.motion->duration() : now.measured), seen.measured, limit);'),
    ('the joints of a braked arm are not watched', PREMISES, '    state.after_brake.begin(', '    if (!FAULT) state.after_brake.begin('),
    ('the limit of the robot is ignored', PREMISES, '  return cell.tracking_error(cell.arm(arm).robot);', '  return FAULT ? cell.checking.tracking_error_rad : cell.tracking_error(cell.arm(arm).robot);'),
    ('joints outside the motion are not checked', PREMISES, 'if (moves(*now.motion, joint)) continue;', 'if (FAULT || moves(*now.motion, joint)) continue;'),
    ('an arm without a motion may move', PREMISES, '  const bool moved = far.distance > limit;', '  const bool moved = !FAULT && far.distance > limit;'),
    ('a resting arm may creep', PREMISES, 'if (rests && !state.rested) begin_rest', 'if (rests && (FAULT || !state.rested)) begin_rest'),
    ('an arm without a controller is judged', PREMISES, 'if (!seen.arms[a].is_connected) {', 'if (!FAULT && !seen.arms[a].is_connected) {'),
    ('authority may be passed', PREMISES, 'state.keeps_authority = rests_at <= now.authority;', 'state.keeps_authority = FAULT || rests_at <= now.authority;'),
    ('an arm that cannot rest at its authority is not noticed', REST, 'return at > now.authority + kSlack ?', 'return !FAULT && at > now.authority + kSlack ?'),
    ('arms are assumed to brake at twice their limits', REST, 'change = law_.brake(', 'change = (FAULT ? 2.0 : 1.0) * law_.brake('),
    ('the hardest brake to the authority is a violation', REST, 'before_ = std::min(last_, now.commanded);', 'before_ = FAULT ? now.commanded : std::min(last_, now.commanded);'),
    ('stops may be ignored', PREMISES, 'moves = told > limit &&', 'moves = !FAULT && told > limit &&'),
    ('feedback may be late', PREMISES, 'is_late = now.feedback_age > timeout;', 'is_late = !FAULT && now.feedback_age > timeout;'),
    ('frozen positions are not noticed', PREMISES, 'if (seen.time - state.changed_at > timeout &&', 'if (!FAULT && seen.time - state.changed_at > timeout &&'),
    ('positions may jump', PREMISES, 'judge(arm, far.joint.has_value(),', 'judge(arm, !FAULT && far.joint.has_value(),'),
    ('a motion may finish anywhere', PREMISES, '  if (far.distance <= limit) return std::nullopt;\n  return MonitorFinding', '  if (FAULT || far.distance <= limit) return std::nullopt;\n  return MonitorFinding'),
    ('a violation is reported once for ever', PREMISES, '(known.has_rested && !rests);', '(!FAULT && known.has_rested && !rests);'),
    ('an arm is stopped once, whatever is resumed', PREMISES, '{ arms_[arm.index()].violations = {}; }', '{\n  if (!FAULT) arms_[arm.index()].violations = {};\n}'),
    ('a resume forgets that an arm rests elsewhere', PREMISES, 'void PremiseCheck::resumed(ArmId arm) {', 'void PremiseCheck::resumed(ArmId arm) {\n  if (FAULT) arms_[arm.index()].moved_at.reset();\n  '),
    ('noise around a limit is reported each time', PREMISES, 'finding.time - *known.held_at < kSameCondition;', 'finding.time - *known.held_at < (FAULT ? std::chrono::milliseconds(15) : kSameCondition);'),
    ('an idle arm may ignore its brake', PREMISES, 'if (found.size() == before || now.is_stopped) return;', 'if (FAULT || found.size() == before || now.is_stopped) return;'),
    ('a person may not move a stopped arm', PREMISES, '|| now.is_stopped) return;', '|| (now.is_stopped && !FAULT)) return;'),
    ('noise counts as motion after a brake', MOVES, 'now.low > before.high + margin', 'now.low > (FAULT ? before.low : before.high) + margin'),
    ('an arm that stood after its brake counts as moving', MOVES, 'std::size_t w = 2;', 'std::size_t w = FAULT ? windows_.size() - 1 : 2;'),
    ('few reports tell motion from noise', MOVES, 'if (reports_ < kReports ||', 'if ((!FAULT && reports_ < kReports) ||'),
    ('noise makes the look-ahead report a pair each time', AHEAD, '>= kSameCondition;', '>= (FAULT ? Duration{} : kSameCondition);'),
    ('the look-ahead comes a period late', AHEAD, 'std::min(end, brakes_to + more);', 'std::min(end, FAULT ? brakes_to - more : brakes_to + more);'),
    ('the look-ahead forgets the braking distance', AHEAD, 'brakes * to_seconds(premises', '(FAULT ? 0.0 : brakes) * to_seconds(premises'),
    ('the look-ahead forgets the reaction time', AHEAD, 'from_seconds(highest * to_seconds(reaction) +', 'from_seconds((FAULT ? 0.0 : highest) * to_seconds(reaction) +'),
    ('the look-ahead forgets the delay of late reports', AHEAD, 'controller.reaction + 2 * late;', 'controller.reaction + (FAULT ? 0 : 2) * late;'),
    ('a certificate counts beyond the authority', AHEAD, 'keep = premises.keeps_authority(arm) && premises.keeps_authority(other);', 'keep = FAULT || (premises.keeps_authority(arm) && premises.keeps_authority(other));'),
    ('a rest between two periods is not seen', PREMISES, 'if (seen.arms[a].starts != state.last.starts)', 'if (!FAULT && seen.arms[a].starts != state.last.starts)'),
    ('the look-ahead trusts authority that is not kept', AHEAD, 'premises.keeps_authority(arm) ? now.authority', 'FAULT || premises.keeps_authority(arm) ? now.authority'),
    ('an arm without reports is assumed to stand', AHEAD, 'if (now.feedback_age > controller.feedback_timeout) brakes_to', 'if (!FAULT && now.feedback_age > controller.feedback_timeout) brakes_to'),
    ('an arm that is being stopped counts as going on', AHEAD, 'if (now.brakes || is_stopping) goes_to', 'if (now.brakes || (is_stopping && !FAULT)) goes_to'),
    ('the lag of an arm is forgotten', AHEAD, 'result.going.late = std::max(Duration{}, lag - behind);', 'result.going.late = FAULT ? Duration{} : std::max(Duration{}, lag - behind);'),
    ('certificates are ignored', AHEAD, 'if (keep && certified.certifies(arm, other)) continue;', 'if (!FAULT && keep && certified.certifies(arm, other)) continue;'),
    ('one stop always suffices', AHEAD, 'made.conflict.a_suffices = !geometry', 'made.conflict.a_suffices = FAULT || !geometry'),
    ('the scene is not in the way', AHEAD, 'certified.certifies_scene(arm)) continue;', 'FAULT || certified.certifies_scene(arm)) continue;'),
    ('an arm off its path does not go on', AHEAD, 'std::abs(off.velocity[j]), PremiseCheck', '(FAULT ? 0.0 : std::abs(off.velocity[j])), PremiseCheck'),
    ('noise counts as speed beyond the limit', AHEAD, 'PremiseCheck::velocity_limit(*cell_, joint));', 'FAULT ? 1e9 : PremiseCheck::velocity_limit(*cell_, joint));'),
    ('more arms are stopped than needed', STOPS, 'if (more > 0 || (more == 0 && !is_first)) continue;', 'if (FAULT || more > 0 || (more == 0 && !is_first)) continue;'),
    ('a conflict is left unresolved', STOPS, '    if (resolves_all) best = stops;', '    if (resolves_all || FAULT) best = stops;'),
    ('a conflict of many arms is left unresolved', STOPS, '  while (!resolves(group, stops)) {', '  while (!FAULT && !resolves(group, stops)) {'),
    ('the monitor allows for as much as certificates', ERRORS, '? off_path + tracking_error :', '? off_path + (FAULT ? 2.0 : 1.0) * tracking_error :'),
], 'model_test': [
    ('the reaction is no part of a response', PROMISES, 'Duration response() const { return feedback_period + kControlPeriod + reaction; }', 'Duration response() const { return feedback_period + kControlPeriod + (FAULT ? Duration{} : reaction); }'),
    ('an arm brakes while its reports are late', PROMISES, 'return std::max(kFreeRunMin, late_response() + kGrantStep);', 'return FAULT ? kFreeRunMin : std::max(kFreeRunMin, late_response() + kGrantStep);'),
    ('a slow arm counts as at rest', PROMISES, 'return std::max(kStandsFromMin, late_response());', 'return FAULT ? kStandsFromMin : std::max(kStandsFromMin, late_response());'),
    ('a motion that ends as late as promised is overdue', PROMISES, 'return std::max(given, late_response());', 'return FAULT ? given : std::max(given, late_response());'),
    ('arms of one motion are told to wait too late', PROMISES, 'return std::max(kOutOfStepMin, 2 * response());', 'return FAULT ? kOutOfStepMin : std::max(kOutOfStepMin, 2 * response());'),
    ('the slowest reaction does not count', PROMISES, 'longest.reaction = std::max(longest.reaction, one.reaction);', 'longest.reaction = FAULT ? one.reaction : std::max(longest.reaction, one.reaction);'),
    ('the longest period does not count', PROMISES, 'std::max(longest.feedback_period, one.feedback_period);', 'FAULT ? one.feedback_period : std::max(longest.feedback_period, one.feedback_period);'),
    ('the longest timeout does not count', PROMISES, 'std::max(longest.feedback_timeout, one.feedback_timeout);', 'FAULT ? one.feedback_timeout : std::max(longest.feedback_timeout, one.feedback_timeout);'),
], 'arm_test': [
    ('a link without reports stays up', LINK, '  } else if (age_ > feedback_timeout_) {', '  } else if (!FAULT && age_ > feedback_timeout_) {'),
    ('a broken connection counts as up', LINK, '  if (!connection.is_up) {', '  if (!FAULT && !connection.is_up) {'),
    ('a lost link is up before its first report', LINK, 'state_ == State::lost && !has_news_) {', '!FAULT && state_ == State::lost && !has_news_) {'),
    ('the age of a report counts from its arrival', LINK, 'measured_at_ = TimePoint(', 'measured_at_ = FAULT ? now : TimePoint('),
    ('a clock that drifts makes reports late', LINK, 'from_seconds(kClockDrift *', 'from_seconds((FAULT ? 0.0 : kClockDrift) *'),
    ('a report that was overtaken is believed', LINK, 'report.sequence > heard_.sequence &&', '(FAULT || report.sequence > heard_.sequence) &&'),
    ('a report on a command that was never sent is believed', LINK, '&& report.acknowledged <= number_;', '&& (FAULT || report.acknowledged <= number_);'),
    ('positions that are no numbers are believed', LINK, '&& report.measured.allFinite();', '&& (FAULT || report.measured.allFinite());'),
    ('the state of an earlier motion counts for the next', LINK, '} else if (motion_->number == 0 || heard_', '} else if (!FAULT && motion_->number == 0 || !FAULT && heard_'),
    ('a rejected motion counts as accepted', LINK, '} else if (heard_.rejected == motion_->number) {', '} else if (!FAULT && heard_.rejected == motion_->number) {'),
    ('a motion that the controller has forgotten counts as idle', LINK, '} else if (heard_.phase == Phase::idle) {', '} else if (!FAULT && heard_.phase == Phase::idle) {'),
    ('a motion lost with its connection is no fault', LINK, 'if (!motion_ || motion_->number <= number_) return;', 'if (FAULT || !motion_ || motion_->number <= number_) return;'),
    ('a motion starts because the controller has connected again', LINK, '  sent_.clear();\n  is_new_', '  if (!FAULT) sent_.clear();\n  is_new_'),
    ('numbers of the old connection go on', LINK, 'number_ = first.acknowledged;', 'number_ = FAULT ? number_ : first.acknowledged;'),
    ('a new connection loses the speed override', LINK, 'if (speed_) command(', 'if (speed_ && !FAULT) command('),
    ('a lost command is not sent again', LINK, '  if (sent_.empty() || !connection', '  if (FAULT || sent_.empty() || !connection'),
    ('an arm is let on while its reports are late', LINK, '  if (state_ == State::up) {', '  if (state_ == State::up || (FAULT && state_ == State::stale)) {'),
    ('a brake is not sent while reports are late', LINK, 'if (is_brake(what)) send', 'if (is_brake(what) && !FAULT) send'),
    ('a motion that waits starts after a brake', LINK, 'return std::holds_alternative<ArmCommand::Follow>(what) ||', 'return !FAULT && std::holds_alternative<ArmCommand::Follow>(what) ||'),
    ('an arm with a command under way counts as settled', LINK, 'if (!sent_.empty() || !waiting_.empty() ||', 'if (!FAULT && !sent_.empty() || !waiting_.empty() ||'),
    ('an arm does not brake for the end of its authority', PROGRESS, 'if (!above(fastest.rate, fastest.progress_s)) return fastest;', 'if (FAULT || !above(fastest.rate, fastest.progress_s)) return fastest;'),
    ('authority may be taken back under a moving arm', PROGRESS, 'authority_ = std::max(authority, stop_from_here());', 'authority_ = FAULT ? authority : std::max(authority, stop_from_here());'),
    ('an arm brakes harder than its limits', RATES, '  const JointState& at_first = sample(first.progress);', '  if (FAULT) share *= 2.0;\n  const JointState& at_first = sample(first.progress);'),
    ('an arm speeds up harder than its limits', RATES, 'const double begin = std::clamp(a.highest,', 'const double begin = std::clamp(FAULT ? 2.0 * a.highest : a.highest,'),
    ('dropped feedback goes on', FAULTY, 'if (active(Kind::drop_feedback)) return nullptr;', 'if (!FAULT && active(Kind::drop_feedback)) return nullptr;'),
    ('a stalled arm takes authority', FAULTY, 'if (active(Kind::stall)) allowed', 'if (!FAULT && active(Kind::stall)) allowed'),
], 'scheduler_test': [
    ('an arm that is resumed beside its path goes on', 'core/scheduler/scheduler.cc', 'for (ArmId arm : input.arms) rejoin(state, arm);', 'for (ArmId arm : input.arms) if (!FAULT) rejoin(state, arm);'),
    ('an arm that pauses beside its path goes on', 'core/scheduler/scheduler.cc', 'arms()) rejoin(state_, arm);', 'arms()) if (!FAULT) rejoin(state_, arm);'),
    ('an arm ahead of its team counts as beside its path', 'core/scheduler/rejoining.cc', 'at < step.farthest;', '!FAULT && at < step.farthest;'),
    ('certificates allow for one measurement of two', ERRORS, 'off_path + 2.0 * tracking_error', 'off_path + (FAULT ? 1.0 : 2.0) * tracking_error'),
], 'collision_test': [
    ('certificates take the error of another arm', ERRORS, 'all_ : by_arm_[arm.index()]', 'all_ : by_arm_[FAULT ? 0 : arm.index()]'),
], 'scenarios_test': [
    ('an arm whose link is lost is not stopped', WATCH, '    if (!is_news ||', '    if ((FAULT && now == Seen::lost) || !is_news ||'),
    ('a late report stops its arm', WATCH, '|| link.state() == ArmLink::State::stale;', '|| (!FAULT && link.state() == ArmLink::State::stale);'),
    ('an arm does not wait for its controller', WATCH, '    details_[a] = link.detail();', '    if (FAULT && now == Seen::waiting) continue;\n    details_[a] = link.detail();'),
    ('an arm waits for its controller for ever', WATCH, '    changes.push_back({ArmId{a}, kind, link.detail()});', '    if (!FAULT || kind != Kind::connected) changes.push_back({ArmId{a}, kind, link.detail()});'),
    ('an arm goes on when its link is back', 'core/executive/watching.cc', '      case Kind::back:\n', '      case Kind::back:\n        if (FAULT) calls_.resume(change.arm);\n'),
], 'dashboard': [
    ('a known event is processed again', 'web/src/server/connection.ts', 'message.seq <= this.since_;', 'message.seq <= (FAULT ? -1 : this.since_);'),
    ('a lost connection is opened from the start', 'web/src/server/connection.ts', "const resume = this.stream_ === null ?", "const resume = FAULT || this.stream_ === null ?"),
    ('ticks outlive another stop', 'web/src/recovery/checklist.ts', 'if (this.ticked_.peek().size > 0) this', 'if (this.ticked_.peek().size > 0 && !FAULT) this'),
    ('a released button keeps the arm moving', 'web/src/control/jog_control.ts', 'if (!is_pressed) return void', 'if (!is_pressed && !FAULT) return void'),
    ('a jog lease is not renewed', 'web/src/control/jog_control.ts', '      this.beat(asked, lease_s);\n    }, every_ms);', '      if (!FAULT) this.beat(asked, lease_s);\n    }, every_ms);'),
    ('control that was lost is shown as kept', 'web/src/control/jog_control.ts', "    this.key.value = null;\n    this.pressed.value = null;\n    ++this.asked_;", "    if (!FAULT) this.key.value = null;\n    this.pressed.value = null;\n    ++this.asked_;"),
    ('a number with a comma is read', 'web/src/frame/number_text.ts', "NaN : Number(text);", "NaN : Number(FAULT ? text.replace(',', '') : text);"),
    ('acknowledged alerts stay open', 'web/src/alerts/alert_list.ts', 'acknowledged === null);', 'FAULT || acknowledged === null);'),
    ('a recording of another cell is shown', 'web/src/recordings/player.ts', "    if (strange !== null) return", "    if (strange !== null && !FAULT) return"),
    ('a past instant shows what came later', 'web/src/state/log.ts', '?.t_s ?? Infinity) <= t_s)', '?.t_s ?? Infinity) <= (FAULT ? t_s + 2 : t_s))'),
    ('another session continues the log', 'web/src/state/log.ts', 'if (this.entries_.length > 0 && this', 'if (!FAULT && this.entries_.length > 0 && this'),
    ('a search finds jobs with any of its words', 'web/src/jobs/filter.ts', 'wanted.every((word)', '(FAULT ? wanted.some.bind(wanted) : wanted.every.bind(wanted))((word)'),
    ('an arm at fault is not listed for recovery', 'web/src/state/shown_state.ts', "link !== 'connecting' && (state === 'stopped' || state === 'fault')", "link !== 'connecting' && (state === 'stopped' || (state === 'fault' && !FAULT))"),
    ('the row under the pointer moves', 'web/src/jobs/frozen_lists.ts', '  if (pointed_at === null || at < 0) return now;', '  if (FAULT || pointed_at === null || at < 0) return now;'),
]}
# Groups of faults in core; if the group's program does not find a fault, the programs of the other ones run, and no server.
CORE = ['monitor_test', 'model_test', 'arm_test', 'scheduler_test', 'collision_test', 'scenarios_test']
SERVER = [name for name in FAULTS if name not in CORE + ['dashboard']] + ['server_command_test', 'server_replay_test', 'audit_test', 'scenarios_test']

seconds_without_fault = {}  # by program that was built


def prepare(tree, program):
    """Builds a program when it is first asked for, and checks that it passes without a fault."""
    if program in seconds_without_fault: return
    build(tree, program)
    begun = time.monotonic()
    code, out = run(tree, program, 0, timeout=3600)
    if code != 0: sys.exit(f'{program} fails without a fault: {failed_in(out) or code}')
    seconds_without_fault[program] = time.monotonic() - begun


def in_dashboard(tree, number):
    """Runs the dashboard's unit tests; if they find nothing, its browser suites one by one."""
    env = dict(os.environ, ARMLOOM_FAULT=str(number), ARMLOOM_BINARY=str(tree / 'build/armloom'))
    done = subprocess.run(['npx', 'vitest', 'run', '--bail=1', '--reporter=verbose'], cwd=tree / 'web', env=env, capture_output=True, text=True)
    found = re.findall(r'(?:FAIL|×)\s+(test/\S+)', done.stdout + done.stderr)
    if done.returncode and found: return found[0]
    for suite in sorted((tree / 'test/browser').glob('*.test.mjs')):
        done = subprocess.run(['node', '--test', suite], cwd=tree, env=env, capture_output=True, text=True)
        if done.returncode: return suite.name
    return None


def first_failure(tree, program, number):
    """Returns the first test of the program that fails with the fault, fails again alone, and passes without it; else None."""
    flaky = []
    while True:
        code, out = run(tree, program, number, '--gtest_fail_fast', f'--gtest_filter=-{":".join(flaky)}', timeout=300 + 3 * seconds_without_fault[program])
        if code == 0: return None
        failed = failed_in(out)
        if not failed: return 'timeout' if code is None else 'crash'
        alone = f'--gtest_filter={failed[0]}'
        if run(tree, program, number, alone)[0] != 0 and run(tree, program, 0, alone)[0] == 0: return failed[0]
        flaky.append(failed[0])


def find(tree, number, first):
    """Returns the first test that finds the fault, and the seconds of its program until then."""
    if first == 'dashboard':
        begun = time.monotonic()
        return in_dashboard(tree, number), time.monotonic() - begun
    for program in [first] + [other for other in (CORE if first in CORE else SERVER) if other != first]:
        prepare(tree, program)
        begun = time.monotonic()
        test = first_failure(tree, program, number)
        if test: return f'{program}: {test}', time.monotonic() - begun
    return None, 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--tree'), parser.add_argument('--only', default='.'), parser.add_argument('--patterns', action='store_true')
    asked = parser.parse_args()
    faults = [(first, fault) for first, some in FAULTS.items() for fault in some]
    texts, missing = put_in([fault for _, fault in faults])
    for one in missing: print('PATTERN NOT FOUND:', one)
    if missing or asked.patterns: return 1 if missing else 0
    chosen = [(number, first, name) for number, (first, (name, *_)) in enumerate(faults, 1) if re.search(asked.only, f'{first}: {name}')]
    if not chosen: sys.exit(f'--only {asked.only} matches no fault')
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(asked.tree or folder) / 'tree'
        copy(tree, texts)
        if 'dashboard' in [first for _, first, _ in chosen]:
            build(tree, 'armloom')
            if not (tree / 'web/node_modules').exists(): (tree / 'web/node_modules').symlink_to(TOP / 'web/node_modules')
            subprocess.run(['npm', 'run', '--silent', 'build'], cwd=tree / 'web', check=True)
        print('| fault | found by | after |\n|---|---|--:|', flush=True)
        missed = 0
        for number, first, name in chosen:
            by, seconds = find(tree, number, first)
            missed += by is None
            print(f'| {name} | {by or "NO TEST"} | {seconds:.0f} s |', flush=True)
    return 1 if missed else 0


if __name__ == '__main__':
    sys.exit(main())
