//! The texts of all messages: what is wrong, then how to mend it.
