#pragma once

#include <string>
#include <vector>

namespace stackabilization::apps {

/// Returns a whole HTML page, also well-formed as XML, of a title, scripts for its head, and its body.
std::string html_page(const std::string& title, const std::string& head, const std::string& body);

/// Returns the text with what means something in HTML replaced, and what is no character of a page shown as
/// such.
std::string escaped(const std::string& text);
/// Returns an element, with attributes after its name, that contains the text.
std::string element(const std::string& name, const std::string& text);
/// Returns an element `ul` or `ol` with an entry per text.
std::string list(const std::string& name, const std::vector<std::string>& items);
/// Returns an image of a file, with words for those who do not see it.
std::string picture(const std::string& file, const std::string& words);

}  // namespace stackabilization::apps
