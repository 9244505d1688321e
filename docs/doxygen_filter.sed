# What doxygen reads of the headers. Line numbers stay as they are.

# Copies, moves and destructors say nothing that their class does not.
s/^ *([A-Za-z]+)\((const \1&|\1&&)( other)?\)( noexcept)?;$//
s/^ *([A-Za-z]+)& operator=\((const \1&|\1&&)( other)?\)( noexcept)?;$//
s/^ *(virtual )?~[A-Za-z]+\(\)( override| = default)?;$//

# One comment after several members of a line holds for each of them.
s|^( *)([A-Za-z_:0-9]+(<[A-Za-z_:0-9<>, -]+>)?) ([a-z_0-9]+)( = [^,;]+)?, ([a-z_0-9]+)( = [^,;]+)?; *///< (.*)$|\1/** \8 */ \2 \4\5; /** \8 */ \2 \6\7;|
s|^( *)([A-Za-z_:0-9]+) ([a-z_0-9]+)( = [^,;]+)?, ([a-z_0-9]+)( = [^,;]+)?, ([a-z_0-9]+)( = [^,;]+)?; *///< (.*)$|\1/** \9 */ \2 \3\4; /** \9 */ \2 \5\6; /** \9 */ \2 \7\8;|

# Images are found by the end of their path.
s|\]\(\.\./docs/images/|](docs/images/|
