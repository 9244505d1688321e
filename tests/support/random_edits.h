#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "stackabilization/deformation/controller_model.h"

/// Random edits of a few per cent, with everything checked that must hold of an accepted one.
namespace stackabilization::random_edits {

struct Tally {
  int accepted = 0;
  int contradicted = 0;  ///< by a symmetry, before anything was solved
  int broken = 0;        ///< refused for another reason
};

/// Makes `count` edits, each on what the accepted ones of the last five led to; every fifth starts from rest
/// and has to keep an extent or the box. By kind of edit.
std::map<std::string, Tally> run(const ControllerModel& model, int count, std::uint64_t seed);

void report(const std::string& name, const std::map<std::string, Tally>& tallies);

/// Share of the edits that no symmetry forbids and that were made.
double acceptance(const std::map<std::string, Tally>& tallies);

}  // namespace stackabilization::random_edits
