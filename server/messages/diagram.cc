#include "server/codec/list_formats.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
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
                   output_only("id", &Side::job, job_id_format()),
                   output_only("state", &Side::state, job_state_format()),
                   output_only("duration_s", &Side::duration, seconds(kPositive)),
                   output_only("progress_s", &Side::progress, seconds({0.0})),
               }));
}

// Describes an interval [from, to].
PartPtr<DiagramCell> stretch(const char* key, Duration DiagramCell::*from,
                             Duration DiagramCell::*to) {
  return output_only(
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
          output_only("state", &Met::state, cell_state_format()),
          output_only("in_s", &Met::after, seconds({0.0}), "Time until the contact, from `t_s` on"),
          output_only("a_s", &Met::at_a, seconds({0.0})),
          output_only("b_s", &Met::at_b, seconds({0.0})),
      }));
}

FormatPtr<DiagramCell> cell_format() {
  return named(
      "DiagramCell", "",
      object<DiagramCell>({
          output_only(
              "state", &DiagramCell::state, cell_state_format(),
              "`free`: every state of the cell keeps the clearance; `conflict`: no state keeps the "
              "clearance; `undecided`: only some states keep the clearance, or nothing is proven"),
          stretch("a_s", &DiagramCell::from_a, &DiagramCell::to_a),
          stretch("b_s", &DiagramCell::from_b, &DiagramCell::to_b),
      }));
}

FormatPtr<DiagramView::Layer> layer_format() {
  using Layer = DiagramView::Layer;
  return object<Layer>({
      output_only(
          "arms", [](const Layer& layer) { return std::pair(layer.arm_a, layer.arm_b); },
          pair_of(text()), "The arm of A and the arm of B"),
      output_if(
          "cells", [](const Layer& layer) { return layer.cells.empty() ? nullptr : &layer.cells; },
          list(cell_format(), {.fewest = 1}),
          "Cells that cover the rectangle of both durations without overlapping each other; absent "
          "with `cells=0`"),
      output_only("first_contact", &Layer::met, nullable(met_format()),
                  "What the motions reach first if both continue from their present progress and "
                  "each rests at its end: the first conflict, or else the first undecided cell. "
                  "null if only free cells follow"),
  });
}

}  // namespace

FormatPtr<DiagramView> diagram_format() {
  using View = DiagramView;
  static const auto format = named(
      "Diagram",
      "The coordination diagram of two motions. The times of cells and of progress are trajectory "
      "time.",
      object<View>({
          output_only("t_s", &View::time, cell_time(), "Cell time of `state` and `progress_s`"),
          output_only("a", &View::a, side_format()),
          output_only("b", &View::b, side_format()),
          output_only("layers", &View::layers, list(layer_format(), {.fewest = 1}),
                      "One layer for each pair of different arms of A and B"),
          output_only("evaluations", &View::evaluations, count()),
          output_only("scene_version", &View::scene_version, count()),
      }));
  return format;
}

}  // namespace armloom
