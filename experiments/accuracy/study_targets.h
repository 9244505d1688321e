#pragma once

#include "common/experiment.h"

namespace stackabilization::experiments {

/// What the authors' resolution makes of the targets of their study: one row per model of theirs, along z
/// with the boxes of the file's frame, with S exactly and as their framing reads it, the target of its own
/// task when it is one of the study's inputs, and every target of the study that it looks to meet and does
/// not. Throws InputError when tasks.txt is missing or damaged; a model that cannot be used is reported as
/// failed.
void compare_study_targets(const std::filesystem::path& paper_data, Report& report);

}  // namespace stackabilization::experiments
