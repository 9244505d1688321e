# To be sourced in the root of the project: sets cache_options, what cmake needs to compile through ccache. None where
# that is not installed. CCACHE_DEPEND: the list of included files that the compiler writes for ninja serves the cache
# too, which else runs the preprocessor once more for each source that it does not know.
cache_options=()
if command -v ccache >/dev/null; then
  cache_options=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1
fi
