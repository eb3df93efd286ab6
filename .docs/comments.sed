# What Doxygen has to be told of comments that are written for the headers' own readers.

# Tables and code stand two blanks in; Markdown wants four.
s|^\( *///\)   |\1      |
# In C: what stands before a declaration, or behind a member; not the headings.
s|^\( *\)/\* \([^-]\)|\1/** \2|
s|\([^ ].*\) /\* |\1 /**< |
# A defaulted comparison needs no words where it stands.
s|operator[=<].* = default;$|& ///< Member by member.|
# What stands in angle brackets is no tag.
s|<UDIM>|\\<UDIM\\>|g
