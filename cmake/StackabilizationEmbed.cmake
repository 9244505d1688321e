# stackabilization_embed(TARGET SOURCE PATH=FILE ...): adds a source to the target that holds the bytes of these files
# under these paths, see apps/common/embedded_files.h. The assembler reads them, which takes no time to compile.
function(stackabilization_embed target source)
  set(assembly "")
  set(declarations "")
  set(rows "")
  set(files "")
  set(row 0)
  foreach(entry ${ARGN})
    string(REGEX MATCH "^([^=]+)=(.+)$" matched ${entry})
    set(path ${CMAKE_MATCH_1})
    set(file ${CMAKE_MATCH_2})
    list(APPEND files ${file})
    string(APPEND assembly "    \"embedded_file_${row}:\\n.incbin \\\"${file}\\\"\\nembedded_file_${row}_end:\\n\"\n")
    string(APPEND declarations "extern const char embedded_file_${row}[], embedded_file_${row}_end[];\n")
    string(APPEND rows "      {\"${path}\", bytes(embedded_file_${row}, embedded_file_${row}_end)},\n")
    math(EXPR row "${row} + 1")
  endforeach()
  set(text "#include \"apps/common/embedded_files.h\"

asm(\".pushsection .rodata\\n\"
${assembly}    \".byte 0\\n.popsection\\n\");

extern \"C\" {
${declarations}}

namespace stackabilization::apps {

namespace {

std::string_view bytes(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

const std::vector<EmbeddedFile>& embedded_files() {
  static const std::vector<EmbeddedFile> files = {
${rows}  };
  return files;
}

}  // namespace stackabilization::apps
")
  file(GENERATE OUTPUT ${source} CONTENT "${text}")
  target_sources(${target} PRIVATE ${source})
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${files}" SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
