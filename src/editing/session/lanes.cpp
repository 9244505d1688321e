#include "editing/session/lanes.h"

#include <string>
#include <utility>

#include "stackabilization/core/failure_sentence.h"

namespace stackabilization::editing {

EditingSession::Job Lanes::start(Lane lane, JobWork work) {
  State& state = state_of(lane);
  state.running = true;
  state.cancelled = std::make_shared<std::atomic<bool>>(false);
  return [this, lane, work = std::move(work), cancelled = state.cancelled](const Deliver& deliver) {
    try {
      work(cancelled, deliver);
    } catch (const std::exception& error) {
      deliver(
          unless(cancelled, [this, lane, sentence = failure_sentence(error)] { failed_(lane, sentence); }));
    }
    deliver([this, lane] { state_of(lane).running = false; });
  };
}

void Lanes::cancel(Lane lane) {
  if (const Cancelled& cancelled = state_of(lane).cancelled) *cancelled = true;
}

void Lanes::cancel_all() {
  cancel(Lane::advice);
  cancel(Lane::automatic);
}

}  // namespace stackabilization::editing
