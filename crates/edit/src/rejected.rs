//! Why a request was turned down.

/// A request that can't be done: what was asked, why not, what is allowed. The document is as it was.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{0}")]
pub struct Rejected(pub String);
