#include "apps/report/page.h"

namespace stackabilization::apps {

namespace {

constexpr const char* page_style = R"(
:root { color-scheme: light; --ink: #212429; --faint: #61666e; --line: #d9dce1; --good: #47803a; --bad: #c0262b; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem; max-width: 110rem; color: var(--ink); background: #fff;
  font: 16px/1.45 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; margin: 0 0 .6rem; }
h3 { font-size: 1rem; margin: 1rem 0 .3rem; }
.verdict { font-size: 1.15rem; margin: 0 0 1rem; }
.headline { margin: 0 0 .6rem; }
.good { color: var(--good); }
.bad { color: var(--bad); }
.faint, .faint a { color: var(--faint); }
.scroll { overflow-x: auto; }
.solutions { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(30rem, 100%), 1fr)); }
article { border: 1px solid var(--line); border-radius: 8px; padding: 1rem 1.2rem; min-width: 0; }
img { display: block; width: 100%; height: auto; margin: .6rem 0; }
table { border-collapse: collapse; margin: 1rem 0; }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
ul, ol { margin: .2rem 0; padding-left: 1.4rem; overflow-wrap: anywhere; }
.strip { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(12rem, 1fr)); }
.strip.wide { grid-template-columns: repeat(auto-fill, minmax(min(22rem, 100%), 1fr)); }
.strip a { color: var(--faint); font-size: .85rem; text-decoration: none; }
details { font-size: .85rem; margin: .4rem 0; }
summary { cursor: pointer; }
.view { margin: 1.2rem 0 1.6rem; border: 1px solid var(--line); border-radius: 8px; overflow: hidden; }
.view:empty { display: none; }
.view .panes { position: relative; height: min(34rem, 70vh); }
.view canvas { display: block; width: 100%; height: 100%; touch-action: pan-y; }
.view .labels { position: absolute; inset: 0; display: flex; pointer-events: none; }
.view .labels span { flex: 1; padding: .5rem .9rem; border-left: 1px solid var(--line); font-size: .95rem; }
.view .labels span:first-child { border-left: 0; }
.view .tools { display: flex; flex-wrap: wrap; gap: .5rem 1.2rem; align-items: center; padding: .5rem .9rem;
  border-top: 1px solid var(--line); font-size: .9rem; color: var(--faint); }
.view .tools label { display: inline-flex; gap: .5rem; align-items: center; }
.view .tools button, .view .tools select { font: inherit; color: var(--ink); background: #fff; border: 1px solid var(--line);
  border-radius: 7px; padding: .15rem .7rem; cursor: pointer; }
pre { white-space: pre-wrap; font: inherit; margin: 0; }
)";

}  // namespace

std::string html_page(const std::string& title, const std::string& head, const std::string& body) {
  return "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
         "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
         "initial-scale=1\"/>\n" +
         element("title", title) + "\n<style>" + page_style + "</style>\n" + head + "</head>\n<body>\n" +
         body + "</body>\n</html>\n";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t';
    if (is_control || c == '\x7f')
      result += "&#xFFFD;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += c;
  }
  return result;
}

std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + escaped(text) + "</" + name.substr(0, name.find(' ')) + ">";
}

std::string list(const std::string& name, const std::vector<std::string>& items) {
  std::string text = "<" + name + ">\n";
  for (const std::string& item : items) text += element("li", item) + "\n";
  return text + "</" + name + ">\n";
}

std::string picture(const std::string& file, const std::string& words) {
  return "<img src=\"" + escaped(file) + "\" alt=\"" + escaped(words) + "\"/>\n";
}

}  // namespace stackabilization::apps
