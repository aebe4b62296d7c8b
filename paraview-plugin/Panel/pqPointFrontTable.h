#pragma once

#include "pqPropertyWidget.h"

#include <QStringList>
#include <QVariant>

class QTableWidget;

/// A text property of several elements a command, as a table whose columns have heads. ParaView
/// 5.11's own widget of such properties has none.
/// XML     panel_widget="pointfront_table" on the property; the heads are hints:
///         <PointFrontTable><Column label="Class"/>...</PointFrontTable>, one for each element.
/// Rows    the last one is empty: whoever writes in it adds a row. A row whose cells are all
///         emptied goes.
/// Width   as narrow as the panel: it never makes the panel scroll sideways.
class pqPointFrontTable : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QVariantList values READ values WRITE setValues NOTIFY valuesChanged)

public:
  pqPointFrontTable(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~pqPointFrontTable() override;

  /// Texts, row by row, without empty rows.
  QVariantList values() const;
  void setValues(const QVariantList& values);

Q_SIGNALS:
  void valuesChanged();

private Q_SLOTS:
  void takeEdit();

private:
  Q_DISABLE_COPY(pqPointFrontTable)

  /// These rows and an empty one.
  void fill(const QVariantList& values);
  bool isEmpty(int row) const;

  QTableWidget* Table;
};
