#pragma once

#include "stackabilization/improvement/history.h"

/// Histories for the tests, of the table of deformation/structures.h.
namespace stackabilization::histories {

/// As a file holds it: numbers of primitives are rounded once.
StructuredShape rest_of_file();

/// Edits that keep the height.
HistoryNode node_of(std::vector<Edit> edits);

/// The root; a child that narrows the legs and a child of that, which widens them; another child of the root.
History small_history();

/// With every kind of entry, numbers that need all their digits among them.
Project rich_project();

bool same(const Edit& a, const Edit& b);

}  // namespace stackabilization::histories
