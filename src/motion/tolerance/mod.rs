//! *Tolerance* and *safe region* (report, section 3.3).

mod commit;
