#include "server/codec/list_formats.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"

namespace armloom {

using namespace formats;

namespace {

FormatPtr<DiagramView::Side> side_format() {
  using Side = DiagramView::Side;
  return named("DiagramSide", "",
               object<Side>({
                   told("id", &Side::job, job_id_format()),
                   told("state", &Side::state, job_state_format()),
                   told("duration_s", &Side::duration, seconds(kPositive)),
                   told("progress_s", &Side::progress, seconds({0.0})),
               }));
}

// Describes an interval [from, to].
PartPtr<DiagramCell> stretch(const char* key, Duration DiagramCell::*from,
                             Duration DiagramCell::*to) {
  return told(
      key, [from, to](const DiagramCell& cell) { return std::pair(cell.*from, cell.*to); },
      pair_of(seconds({0.0})), "Interval [from, to]");
}

FormatPtr<DiagramCell::State> cell_state_format() {
  using State = DiagramCell::State;
  return choice<State>();
}

FormatPtr<DiagramContact> met_format() {
  using Met = DiagramContact;
  return named(
      "DiagramContact", "",
      object<Met>({
          told("state", &Met::state, cell_state_format()),
          told("in_s", &Met::after, seconds({0.0}), "Time until the contact, from `t_s` on"),
          told("a_s", &Met::at_a, seconds({0.0})),
          told("b_s", &Met::at_b, seconds({0.0})),
      }));
}

FormatPtr<DiagramCell> cell_format() {
  return named("DiagramCell", "",
               object<DiagramCell>({
                   told("state", &DiagramCell::state, cell_state_format(),
                        "`free`: every state of the cell keeps the clearance; `conflict`: no state "
                        "keeps it; `undecided`: some states keep it, or neither is proven"),
                   stretch("a_s", &DiagramCell::from_a, &DiagramCell::to_a),
                   stretch("b_s", &DiagramCell::from_b, &DiagramCell::to_b),
               }));
}

FormatPtr<DiagramView::Layer> layer_format() {
  using Layer = DiagramView::Layer;
  return object<Layer>({
      told(
          "arms", [](const Layer& layer) { return std::pair(layer.arm_a, layer.arm_b); },
          pair_of(text()), "The arm of A and the arm of B"),
      told_if(
          "cells", [](const Layer& layer) { return layer.cells.empty() ? nullptr : &layer.cells; },
          list(cell_format(), {.fewest = 1}),
          "Cells that cover the rectangle of both durations without overlap; absent with "
          "`cells=0`"),
      told("first_contact", &Layer::met, nullable(met_format()),
           "The first conflict, or else the first undecided cell, if both motions continue from "
           "their present progress and each rests at its end; null if only free cells follow"),
  });
}

}  // namespace

FormatPtr<DiagramView> diagram_format() {
  using View = DiagramView;
  static const auto format =
      named("Diagram",
            "The coordination diagram of two motions. Times in cells and of progress are "
            "trajectory time.",
            object<View>({
                told("t_s", &View::time, cell_time(), "Cell time of `state` and `progress_s`"),
                told("a", &View::a, side_format()),
                told("b", &View::b, side_format()),
                told("layers", &View::layers, list(layer_format(), {.fewest = 1}),
                     "One layer for each pair of different arms of A and B"),
                told("evaluations", &View::evaluations, count()),
                told("scene_version", &View::scene_version, count()),
            }));
  return format;
}

}  // namespace armloom
