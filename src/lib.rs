//! Energy-entropy-momentum integration.
